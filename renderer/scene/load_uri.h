#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// What a glTF may point at: data within its own text, and files beside it.
namespace celadon::loaders {

[[nodiscard]] bool isDataUri(std::string_view uri);

/// The bytes of a data URI, base64 or percent-encoded; nothing when it is malformed.
[[nodiscard]] std::optional<std::string> decodeDataUri(std::string_view uri);

/// A file named by a relative reference, percent-encoded or not, relative to the folder of `file`;
/// nothing when it has a scheme or is absolute: a model must not reach for the network, or name
/// places of one machine. ".." is allowed: exporters keep pictures beside the model's folder.
[[nodiscard]] std::optional<std::filesystem::path> resolveUri(const std::filesystem::path& file,
                                                              std::string_view uri);

} // namespace celadon::loaders
