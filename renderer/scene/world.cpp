#include "renderer/scene/world.h"

#include "renderer/scene/handle_ground.h"
#include "renderer/scene/world_atlas.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace celadon {

namespace {

constexpr double kDefaultDiameterMm = 100.0;
/// Squared lengths must stay finite in float, on the GPU as well.
constexpr double kLargestRadiusMm = 1e15;
constexpr double kSmallestRadiusMm = 1e-12;

/// The material of each mesh, null for an opaque one (DESIGN section 1, "What scatters").
std::vector<MaterialPointer> scatteringMaterials(const Scene& scene,
                                                 const MaterialPointer& everywhere,
                                                 const std::vector<MaterialPointer>& named,
                                                 const MaterialPointer& fallback) {
    std::vector<MaterialPointer> materials(scene.meshes.size(), everywhere);
    if (everywhere) {
        return materials;
    }
    bool any = false;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const auto look = static_cast<std::size_t>(scene.meshes[m].material);
        if (look < named.size() && named[look]) {
            materials[m] = named[look];
            any = true;
        }
    }
    if (!any) {
        std::fill(materials.begin(), materials.end(), fallback);
    }
    return materials;
}

/// Loaders have checked this already; a deformation or a new maker of scenes may not have.
void requireFinite(const Scene& scene, const std::string& subject) {
    for (const Mesh& mesh : scene.meshes) {
        for (const glm::vec3& p : mesh.positions) {
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                throw InputError(
                    subject, fmt::format("mesh '{}' has a vertex at NaN or infinity", mesh.name),
                    "check the model's coordinates");
            }
        }
    }
}

double requirePositive(double value, const char* option) {
    if (!std::isfinite(value) || value <= 0.0) {
        throw UsageError(fmt::format("{} {:g}", option, value),
                         "not a positive number of millimeters");
    }
    return value;
}

int indexOf(std::vector<MaterialPointer>& materials, const MaterialPointer& material) {
    if (!material) {
        return -1;
    }
    const auto found = std::find(materials.begin(), materials.end(), material);
    if (found == materials.end()) {
        materials.push_back(material);
        return static_cast<int>(materials.size()) - 1;
    }
    return static_cast<int>(found - materials.begin());
}

void scaleMesh(Mesh& mesh, double factor) {
    for (glm::vec3& position : mesh.positions) {
        position = glm::vec3(glm::dvec3(position) * factor);
    }
}

void scaleViewpoints(std::vector<Camera>& cameras, std::vector<Light>& lights, double factor) {
    for (Camera& camera : cameras) {
        camera.eye *= factor;
        camera.at *= factor;
        if (camera.orthographicHeight) {
            *camera.orthographicHeight *= factor;
        }
    }
    for (Light& light : lights) {
        light.position *= factor; // its color is per square meter or steradian, whatever the scale
    }
}

void scaleIntoMillimeters(Scene& scene, double unit) {
    for (Mesh& mesh : scene.meshes) {
        scaleMesh(mesh, unit);
    }
    scaleViewpoints(scene.cameras, scene.lights, unit);
}

void requireReachableRadius(const std::string& subject, double radiusMm) {
    if (!(radiusMm >= kSmallestRadiusMm && radiusMm <= kLargestRadiusMm)) {
        throw InputError(
            subject, fmt::format("its bounding sphere would have a radius of {:g} mm", radiusMm),
            "set its size with --diameter");
    }
}

} // namespace

double chooseMillimetersPerUnit(const Scene& scene, const WorldScale& scale,
                                double diameterInUnits) {
    if (scale.millimetersPerUnit && scale.diameterMm) {
        throw UsageError("--scale and --diameter", "both say how large the model is",
                         "give one of them");
    }
    if (scale.millimetersPerUnit) {
        return requirePositive(*scale.millimetersPerUnit, "--scale");
    }
    if (scale.diameterMm) {
        return requirePositive(*scale.diameterMm, "--diameter") / diameterInUnits;
    }
    if (scene.millimetersPerUnit) {
        return *scene.millimetersPerUnit;
    }
    return kDefaultDiameterMm / diameterInUnits;
}

World buildWorld(Scene scene, const MaterialPointer& override,
                 const std::vector<MaterialPointer>& namedMaterials,
                 const MaterialPointer& fallback, const WorldScale& scale) {
    const std::string subject = scene.name.empty() ? "the model" : fmt::format("'{}'", scene.name);
    const std::vector<MaterialPointer> materials =
        scatteringMaterials(scene, override, namedMaterials, fallback);

    std::vector<bool> scatters(materials.size());
    std::transform(materials.begin(), materials.end(), scatters.begin(),
                   [](const MaterialPointer& material) { return material != nullptr; });
    if (std::find(scatters.begin(), scatters.end(), true) == scatters.end()) {
        throw InputError(subject, "nothing in it scatters light",
                         "name a material with --material");
    }
    requireFinite(scene, subject);
    const BoundingSphere rest = boundingSphere(scene, scatters);
    if (rest.radius <= 0.0) {
        throw InputError(subject, "all its vertices are at one place",
                         "check the model's coordinates");
    }
    const double unit = chooseMillimetersPerUnit(scene, scale, 2.0 * rest.radius);
    const double radiusMm = unit * rest.radius;
    requireReachableRadius(subject, radiusMm);

    World world;
    world.handleGround = std::make_shared<HandleGround>();
    world.millimetersPerUnit = unit;
    scaleIntoMillimeters(scene, unit);
    world.scatteringSphere = boundingSphere(scene, scatters);
    world.sceneSphere = boundingSphere(scene);
    if (!(world.sceneSphere.radius <= kLargestRadiusMm)) {
        throw InputError(subject, "its opaque parts reach further than numbers do",
                         "check the model's coordinates");
    }
    world.looks = std::move(scene.materials);
    world.images = std::move(scene.images);
    world.cameras = std::move(scene.cameras);
    world.lights = std::move(scene.lights);
    world.warnings = std::move(scene.warnings);
    world.rig = std::move(scene.rig);
    world.meshes.reserve(scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        CELADON_ASSERT(scene.meshes[m].material >= 0 &&
                       static_cast<std::size_t>(scene.meshes[m].material) < world.looks.size());
        world.meshes.push_back(
            {std::move(scene.meshes[m]), indexOf(world.materials, materials[m])});
    }
    addMissingUvs(world);
    return world;
}

World resized(World world, double factor) {
    requireReachableRadius("the model", factor * world.scatteringSphere.radius);
    requireReachableRadius("the model", factor * world.sceneSphere.radius);
    for (WorldMesh& part : world.meshes) {
        scaleMesh(part.mesh, factor);
    }
    scaleViewpoints(world.cameras, world.lights, factor);
    for (BoundingSphere* const sphere : {&world.scatteringSphere, &world.sceneSphere}) {
        sphere->center *= factor;
        sphere->radius *= factor;
    }
    world.millimetersPerUnit *= factor;
    world.handleGround = std::make_shared<HandleGround>();
    world.warnings.clear();
    return world;
}

} // namespace celadon
