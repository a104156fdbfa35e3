#include "renderer/scene/load_gltf.h"

#include "renderer/scene/animation.h"
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_animation.h"
#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/load_gltf_material.h"
#include "renderer/scene/load_gltf_mesh.h"
#include "renderer/scene/load_gltf_nodes.h"
#include "renderer/scene/load_gltf_rig.h"
#include "subedit/errors.h"

#include <algorithm>

namespace celadon::loaders {

namespace {

/// Takes away the material that stands for "none" when every primitive has one.
void dropUnusedLastMaterial(Scene& scene) {
    const int last = static_cast<int>(scene.materials.size()) - 1;
    const bool used = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                  [&](const Mesh& mesh) { return mesh.material == last; });
    if (!used && last > 0) {
        scene.materials.pop_back();
    }
}

} // namespace

Scene loadGltf(const std::filesystem::path& file, std::string_view content) {
    GltfDocument document;
    openGltf(file, content, document);
    Scene scene;
    scene.name = file.stem().string();
    scene.millimetersPerUnit = 1000.0; // glTF is in meters
    scene.warnings = document.warnings;
    const auto rig = std::make_shared<Rig>(readRig(document));
    rig->animations = readAnimations(document, scene.warnings);
    const RigPose rest = restPose(*rig);
    const std::vector<std::size_t> shown = shownNodes(document);
    addMeshes(document, *rig, rest, shown, scene);
    if (scene.meshes.empty()) {
        throw InputError(quoted(file), "its scene shows no triangles",
                         "export a surface, not points, lines or an empty scene");
    }
    addMaterials(document, scene);
    dropUnusedLastMaterial(scene);
    addCamerasAndLights(document, rest.nodes, shown, *rig, scene);
    if (!document.deformers.empty()) {
        rig->deformers = std::make_shared<const DeformerStack>(std::move(document.deformers));
    }
    if (!rig->animations.empty() || rig->deformers) {
        scene.rig = rig;
    }
    return scene;
}

} // namespace celadon::loaders
