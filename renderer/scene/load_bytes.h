#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

/// Whole files in memory for the model readers, with the errors a user can act on.
namespace celadon::loaders {

/// Files above this are refused before anything is allocated (2 GiB: offsets fit 32 bits signed).
inline constexpr std::uintmax_t kMaxFileBytes = (std::uintmax_t{1} << 31) - 1;

/// More triangles or vertices than this are refused: some 1.5 GB of mesh.
inline constexpr std::uint64_t kMaxElements = 30'000'000;

/// The path in single quotes, as every message has it.
[[nodiscard]] std::string quoted(const std::filesystem::path& file);

/// The whole file.
/// @throws InputError: missing, a directory or device, unreadable, empty, larger than `maxBytes`
[[nodiscard]] std::string readFile(const std::filesystem::path& file,
                                   std::uintmax_t maxBytes = kMaxFileBytes);

/// Text from a file, made fit for one line of a message: cut to `longest` characters, printable.
[[nodiscard]] std::string excerpt(std::string_view text, std::size_t longest = 40);

/// "1 triangle", "12 triangles".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);

} // namespace celadon::loaders
