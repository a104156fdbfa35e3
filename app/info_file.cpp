#include "app/command_info.h"
#include "app/describe_material.h"
#include "app/log.h"
#include "app/overwriting.h"
#include "app/render_scene.h"
#include "renderer/scene/atlas.h"
#include "renderer/scene/describe_scene.h"
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/write_obj.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/shipped_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace celadon::app {
namespace {

/// A picture, or a word with neither folder nor ending, names a material; the rest are models.
bool namesMaterial(const std::string& file) {
    const std::filesystem::path path(file);
    return path.extension() == ".exr" ||
           (!file.starts_with("builtin:") && !path.has_extension() && !path.has_parent_path());
}

/// Which meshes would scatter without --material (DESIGN section 1): those that name a SubEdit
/// material, else all.
std::vector<bool> scatteringMeshes(const Scene& scene) {
    std::vector<bool> scatters;
    for (const Mesh& mesh : scene.meshes) {
        scatters.push_back(
            scene.materials[static_cast<std::size_t>(mesh.material)].subedit.has_value());
    }
    if (std::find(scatters.begin(), scatters.end(), true) == scatters.end()) {
        scatters.assign(scene.meshes.size(), true);
    }
    return scatters;
}

/// Indices of the meshes that share the automatic atlas.
std::vector<std::size_t> meshesWithoutUvs(const Scene& scene, const std::vector<bool>& scatters) {
    std::vector<std::size_t> indices;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (scatters[m] && scene.meshes[m].uvs.empty()) {
            indices.push_back(m);
        }
    }
    return indices;
}

/// The atlas that a render makes, on the meshes in model units. It is computed in millimeters as
/// there, since coordinates scaled after rounding may fold charts elsewhere.
AtlasReport addAtlas(Scene& scene, const std::vector<std::size_t>& indices,
                     double millimetersPerUnit) {
    std::vector<Mesh> scaled;
    std::vector<const Mesh*> pointers;
    scaled.reserve(indices.size());
    for (const std::size_t m : indices) {
        Mesh& mesh = scaled.emplace_back(scene.meshes[m]);
        for (glm::vec3& position : mesh.positions) {
            position = glm::vec3(glm::dvec3(position) * millimetersPerUnit);
        }
        pointers.push_back(&mesh);
    }
    const Atlas atlas = generateAtlas(pointers);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        applyAtlas(atlas.meshes[i], scene.meshes[indices[i]]);
    }
    return atlas.report;
}

void describeModel(const InfoOptions& options) {
    Scene scene = readModel(options.file);
    const std::vector<bool> scatters = scatteringMeshes(scene);
    const double diameter = 2.0 * boundingSphere(scene, scatters).radius;
    if (!(diameter > 0.0)) {
        throw InputError(fmt::format("'{}'", options.file), "all its vertices are at one place",
                         "check the model's coordinates");
    }
    const double unit = chooseMillimetersPerUnit(scene, {}, diameter);
    const std::vector<std::size_t> bare = meshesWithoutUvs(scene, scatters);
    for (const std::string& line : describeScene(scene)) {
        fmt::print("{}\n", line);
    }
    fmt::print("rendered at: {:.6g} mm per unit, a diameter of {:.6g} mm\n", unit, unit * diameter);
    fmt::print("automatic atlas: {}\n",
               bare.empty() ? std::string("none, what scatters has texture coordinates")
                            : fmt::format("for {} of {} meshes", bare.size(), scene.meshes.size()));
    if (!options.writeAtlas) {
        return;
    }
    if (!bare.empty()) {
        const AtlasReport report = addAtlas(scene, bare, unit);
        fmt::print("charts: {}\n", report.charts);
        fmt::print("coverage: {:.1f} % of the unit square\n", 100.0 * report.coverage);
        fmt::print("area distortion: {:.3f} on average, {:.3f} at most (99.9 % of the area)\n",
                   report.areaDistortionMean, report.areaDistortionMax);
    }
    writeObj(scene, *options.writeAtlas);
}

/// The model with its normals and texture coordinates as a render has them.
World readRest(const InfoOptions& options) {
    Scene scene = readModel(options.file);
    const MaterialPointer any = readMaterialArgument(subedit::kDefaultMaterial);
    std::vector<MaterialPointer> named;
    for (const SurfaceMaterial& look : scene.materials) {
        named.push_back(look.subedit ? any : nullptr); // which one does not matter here
    }
    World rest = buildWorld(std::move(scene), nullptr, named, any, options.scale);
    for (const std::string& warning : rest.warnings) {
        log::warning("{}", warning);
    }
    return rest;
}

/// The pose that a render would show, back in model units.
void writePosedMesh(const InfoOptions& options) {
    const World rest = readRest(options);
    const Motion motion = makeMotion(rest, options.motion);
    for (const std::string& warning : motion.warnings()) {
        log::warning("{}", warning);
    }
    const Pose pose = motion.at(options.motion.timeSeconds.value_or(0.0));
    if (const auto effort = motion.handleEffort()) {
        fmt::print(
            "handles: {} vertices on {} nodes, {} iterations of {:.2f} ms, {:.1f} ms in all\n",
            effort->vertices, effort->nodes, effort->iterations, effort->msPerIteration,
            effort->ms);
    }
    World world = posedWorld(rest, pose);
    std::vector<const Mesh*> meshes;
    for (WorldMesh& part : world.meshes) {
        for (glm::vec3& position : part.mesh.positions) {
            position = glm::vec3(glm::dvec3(position) / world.millimetersPerUnit);
        }
        meshes.push_back(&part.mesh);
    }
    writeObj(meshes, *options.writeMesh);
    fmt::print("mm per unit: {:.9g}\n", world.millimetersPerUnit);
}

/// The file itself with other deformers. The model is read whole first: what is no glTF, or a glTF
/// that such deformers cannot bend, is refused.
void writeDeformedGltf(const InfoOptions& options) {
    const std::filesystem::path file = options.file;
    const std::filesystem::path& output = *options.writeGltf;
    if (file.extension() != output.extension() ||
        (output.extension() != ".glb" && output.extension() != ".gltf")) {
        throw UsageError("--write-gltf", "takes a .glb to a .glb, or a .gltf to a .gltf");
    }
    if (output.extension() == ".gltf" && std::filesystem::absolute(file).parent_path() !=
                                             std::filesystem::absolute(output).parent_path()) {
        throw UsageError("--write-gltf", "a .gltf names the files beside it",
                         "write it into the folder of the model");
    }
    const World rest = readRest(options);
    static_cast<void>(makeMotion(rest, options.motion));
    writeFileAtomically(output,
                        loaders::gltfWithDeformers(file, loaders::readFile(file),
                                                   *readDeformations(options.motion.deformations)));
}

} // namespace

void describeFile(const InfoOptions& options) {
    const bool isMaterial = namesMaterial(options.file);
    const auto checkOutput = [&](const char* option, const auto& output) {
        if (isMaterial) {
            throw UsageError(option,
                             fmt::format("needs a model, and '{}' is a material", options.file));
        }
        refuseOverwriting({{option, output}}, {{"the model", options.file}});
    };
    if (options.writeAtlas) {
        checkOutput("--write-atlas", *options.writeAtlas);
    }
    if (options.writeMesh) {
        checkOutput("--write-mesh", *options.writeMesh);
        writePosedMesh(options);
        return;
    }
    if (options.writeGltf) {
        checkOutput("--write-gltf", *options.writeGltf);
        writeDeformedGltf(options);
        return;
    }
    if (isMaterial) {
        describeMaterial(options.file, false);
    } else {
        describeModel(options);
    }
}

} // namespace celadon::app
