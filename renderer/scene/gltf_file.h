#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// How a glTF 2.0 becomes files: its JSON and one buffer.
namespace celadon::loaders {

/// The bytes of a .glb (glTF 2.0, section 4.4).
[[nodiscard]] std::string binaryGltf(const nlohmann::json& document,
                                     std::optional<std::string_view> buffer);

/// Appends bytes to the buffer, and a view of them to the document.
/// @return the view's index
std::size_t appendView(nlohmann::json& document, std::string& buffer, std::string_view bytes);

/// Writes FILE.glb, or FILE.gltf with FILE.bin beside it, and makes `buffer` the only one of the
/// document.
/// @throws OutputError; files that were there before are then untouched
void writeGltfFile(nlohmann::json document, const std::string& buffer,
                   const std::filesystem::path& file);

/// Where the buffer of a .gltf goes.
[[nodiscard]] std::filesystem::path bufferBeside(const std::filesystem::path& file);

/// @throws UsageError: neither .gltf nor .glb
void checkGltfName(const std::filesystem::path& file);

} // namespace celadon::loaders
