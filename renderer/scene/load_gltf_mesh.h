#pragma once

#include "renderer/scene/animation.h"
#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/scene.h"

#include <vector>

/// Triangles of a glTF in world space: one Mesh per primitive and node that shows it.
namespace celadon::loaders {

/// Fills Scene::meshes with the rest pose: morph weights, then skin or node transform. Where the
/// transform mirrors, triangles are turned over, so that the front stays the front. Missing normals
/// are flat. Mesh::material is the glTF's, or the number of materials when it names none. Where the
/// rig has animations, meshes keep their bindings, and the triangles that the rest pose alone folds
/// away.
/// @throws InputError: not finite, an index past its vertices, more than kMaxElements in all
void addMeshes(const GltfDocument& document, const Rig& rig, const RigPose& rest,
               const std::vector<std::size_t>& shown, Scene& scene);

} // namespace celadon::loaders
