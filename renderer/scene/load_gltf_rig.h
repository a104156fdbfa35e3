#pragma once

#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/rig.h"

/// Nodes and skins of a glTF.
namespace celadon::loaders {

/// Everything but the animations, and whose cameras and lights they carry.
/// @throws InputError: an inverse bind matrix that is not finite
[[nodiscard]] Rig readRig(const GltfDocument& document);

} // namespace celadon::loaders
