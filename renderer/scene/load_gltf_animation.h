#pragma once

#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/load_json.h"
#include "renderer/scene/rig.h"

#include <string>
#include <vector>

/// Animations of a glTF (2.0, 3.11), read by ourselves: tinygltf neither checks them nor says where
/// they are wrong.
namespace celadon::loaders {

/// What the JSON says of them, with indices checked.
/// @throws InputError with the animation, sampler or channel
[[nodiscard]] std::vector<GltfAnimation> listAnimations(const JsonElement& root);

/// The keys themselves. Channels that move nothing are left out: without a node, or of morph
/// weights where the node's mesh has no targets.
/// @throws InputError: keys not finite, out of order, of another number than their values; a
///         rotation of no length; a node that has a matrix; a property animated twice
[[nodiscard]] std::vector<Animation> readAnimations(const GltfDocument& document,
                                                    std::vector<std::string>& warnings);

} // namespace celadon::loaders
