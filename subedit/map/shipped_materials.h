#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The materials that come with the program, found by name.
namespace celadon::subedit {

inline constexpr const char* kDefaultMaterial = "yellow_wax";

/// A material given by the user: a file, or the name of a shipped one.
/// @param nameOrPath anything with a folder or an extension is a path and is returned as it is
/// @throws InputError listing the known names
[[nodiscard]] std::filesystem::path findMaterial(const std::string& nameOrPath);

/// Names of the shipped materials that are there, sorted.
[[nodiscard]] std::vector<std::string> shippedMaterialNames();

/// The folder they are in: that of environment variable CELADON_MATERIALS if set, else the one
/// installed with the program, else the source tree's.
/// @throws InputError if CELADON_MATERIALS names no folder, or none is found
[[nodiscard]] std::filesystem::path shippedMaterialFolder();

} // namespace celadon::subedit
