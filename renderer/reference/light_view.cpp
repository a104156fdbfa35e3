#include "renderer/reference/light_view.h"

#include "renderer/reference/incidence.h"
#include "renderer/shading/fresnel.h"
#include "subedit/assert.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <cstdlib>

namespace celadon {

namespace {

constexpr double kSquareMetersPerSquareMillimeter = 1e-6;

/// Right-handed axes with the given third one.
struct Frame {
    glm::dvec3 x, y, z;
};

Frame frameAbout(glm::dvec3 z) {
    const glm::dvec3 other =
        std::abs(z.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(other, z));
    return {x, glm::cross(z, x), z};
}

/// What a ray that carries `irradiance` lights up; `crossSectionMm2` at that distance.
template<typename CrossSection>
void addPatch(const RayScene& rays, const Light& light, glm::dvec3 origin, glm::dvec3 direction,
              CrossSection&& crossSectionMm2, std::vector<Patch>& patches) {
    const std::optional<RayScene::Hit> hit = rays.nearest(origin, direction);
    if (!hit) {
        return;
    }
    const SurfacePoint point = surfacePoint(rays.world(), hit->place);
    const std::optional<Facing> facing = facingLight(point, -direction);
    if (point.material < 0 || !facing) {
        return;
    }
    const glm::dvec3 irradiance = incidenceAt(light, point.positionMm).irradiance;
    const double area = crossSectionMm2(hit->distanceMm);
    const double eta = static_cast<double>(rays.world().materials[point.material]->eta);
    const glm::dvec3 flux = fresnelTransmittance(facing->shadingCosine, eta) * irradiance * area *
                            kSquareMetersPerSquareMillimeter;
    if (flux != glm::dvec3(0.0)) {
        patches.push_back(
            makeTexelPatch(glm::vec3(point.positionMm), glm::vec3(point.geometricNormal),
                           glm::vec3(flux), static_cast<float>(area),
                           static_cast<float>(facing->geometricCosine), point.uv, point.material));
    }
}

/// Rows of texels in parallel, put together in order.
template<typename VisitTexel>
std::vector<Patch> visitTexels(int size, VisitTexel&& visitTexel) {
    std::vector<std::vector<Patch>> rows(static_cast<std::size_t>(size));
    tbb::parallel_for(0, size, [&](int y) {
        for (int x = 0; x < size; ++x) {
            // Of the texel's center, in [-1, 1].
            const glm::dvec2 place((2 * x + 1 - size) / static_cast<double>(size),
                                   (2 * y + 1 - size) / static_cast<double>(size));
            visitTexel(place, rows[static_cast<std::size_t>(y)]);
        }
    });
    std::vector<Patch> patches;
    for (const std::vector<Patch>& row : rows) {
        patches.insert(patches.end(), row.begin(), row.end());
    }
    return patches;
}

std::vector<Patch> parallelView(const RayScene& rays, const Light& light, int size) {
    const BoundingSphere& sphere = rays.world().scatteringSphere;
    const BoundingSphere& all = rays.world().sceneSphere;
    const Frame frame = frameAbout(light.direction);
    const double side = 2.0 * sphere.radius / size;
    // Far enough back that everything that can shadow is in front.
    const double back = sphere.radius + 2.0 * all.radius + glm::length(all.center - sphere.center);
    return visitTexels(size, [&](glm::dvec2 place, std::vector<Patch>& patches) {
        const glm::dvec3 origin = sphere.center +
                                  sphere.radius * (place.x * frame.x + place.y * frame.y) -
                                  back * frame.z;
        addPatch(
            rays, light, origin, frame.z, [&](double) { return side * side; }, patches);
    });
}

std::vector<Patch> perspectiveView(const RayScene& rays, const Light& light, const Frame& frame,
                                   double tangent, int size) {
    const double side = 2.0 * tangent / size; // of a texel at distance 1
    return visitTexels(size, [&](glm::dvec2 place, std::vector<Patch>& patches) {
        const glm::dvec3 towards = frame.z + tangent * (place.x * frame.x + place.y * frame.y);
        const double length = glm::length(towards);
        const double solidAngle = side * side / (length * length * length);
        addPatch(
            rays, light, light.position, towards / length,
            [&](double t) { return t * t * solidAngle; }, patches);
    });
}

} // namespace

std::vector<Patch> lightViewPatches(const RayScene& rays, const Light& light, int size) {
    CELADON_ASSERT(size >= 1);
    if (light.kind == Light::Kind::Directional) {
        return parallelView(rays, light, size);
    }
    constexpr double kNear = 1.15; // a frustum from there is 120 degrees wide
    const BoundingSphere& sphere = rays.world().scatteringSphere;
    const glm::dvec3 delta = sphere.center - light.position;
    const double distance = glm::length(delta);
    if (distance > kNear * sphere.radius) {
        const double sine = sphere.radius / distance;
        const double tangent = sine / std::sqrt(1.0 - sine * sine);
        return perspectiveView(rays, light, frameAbout(delta / distance), tangent, size);
    }
    std::vector<Patch> patches;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 z(0.0);
            z[axis] = sign;
            const std::vector<Patch> face = perspectiveView(rays, light, frameAbout(z), 1.0, size);
            patches.insert(patches.end(), face.begin(), face.end());
        }
    }
    return patches;
}

std::vector<Patch> lightViewPatches(const World& world, const Light& light, int size) {
    return lightViewPatches(RayScene(world), light, size);
}

} // namespace celadon
