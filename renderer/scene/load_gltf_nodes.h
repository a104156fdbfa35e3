#pragma once

#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <vector>

/// The nodes of a glTF that are shown, and what looks and shines from there.
namespace celadon::loaders {

/// Nodes below the default scene's, parents first; the first scene's, or all, when none is default.
[[nodiscard]] std::vector<std::size_t> shownNodes(const GltfDocument& document);

/// Adds the cameras and lights of the shown nodes; the scene's meshes must be there already, for
/// Camera::at looks at the depth of their center. The rig learns which nodes carry them.
void addCamerasAndLights(const GltfDocument& document, const std::vector<glm::dmat4>& world,
                         const std::vector<std::size_t>& shown, Rig& rig, Scene& scene);

} // namespace celadon::loaders
