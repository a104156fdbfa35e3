#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

/// The two parts of a .glb; a .gltf is all JSON.
namespace celadon::loaders {

struct GltfContainer {
    std::string_view json;
    std::optional<std::string_view> binary; ///< the BIN chunk of a .glb
};

/// Views into `content`, told apart by the magic number.
/// @throws InputError: not version 2, lengths that the file cannot hold, no JSON chunk
[[nodiscard]] GltfContainer splitContainer(const std::filesystem::path& file,
                                           std::string_view content);

} // namespace celadon::loaders
