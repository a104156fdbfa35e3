#pragma once

#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <vector>

/// The tree of nodes of a glTF: where things are, and what looks and shines from there.
namespace celadon::loaders {

/// World matrix of every node, whether the scene shows it or not (joints may lie outside).
[[nodiscard]] std::vector<glm::dmat4> worldMatrices(const GltfDocument& document);

/// Nodes below the default scene's, parents first; the first scene's, or all, when none is default.
[[nodiscard]] std::vector<std::size_t> shownNodes(const GltfDocument& document);

/// Adds the cameras and lights of the shown nodes; the scene's meshes must be there already, for
/// Camera::at looks at the depth of their center.
void addCamerasAndLights(const GltfDocument& document, const std::vector<glm::dmat4>& world,
                         const std::vector<std::size_t>& shown, Scene& scene);

} // namespace celadon::loaders
