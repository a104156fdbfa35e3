#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string_view>

/// glTF 2.0, .gltf and .glb, told apart by their first bytes. The rest pose: skins and morph
/// targets are applied as the nodes of the file stand. tinygltf maps the JSON to structures, after
/// load_gltf_check has held every number in it against the data; buffers and pictures are resolved
/// here, because tinygltf trusts sizes and gives up the model for one bad picture.
namespace celadon::loaders {

/// @throws InputError naming the element of the file: "'a.gltf', accessor 3 'positions'"
[[nodiscard]] Scene loadGltf(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
