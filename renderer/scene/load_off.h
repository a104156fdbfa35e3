#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string_view>

/// Object File Format of Geomview, ascii: OFF with the optional prefixes ST, C, N (texture
/// coordinates with v up, colors, normals). Binary, 4-D and n-D files are refused.
namespace celadon::loaders {

/// @throws InputError with the line, or the number of the vertex or face
[[nodiscard]] Scene loadOff(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
