#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string_view>

/// Wavefront OBJ: v, vt, vn and f, with negative indices, normals and texture coordinates per
/// corner. Groups and materials become one mesh (.mtl files are not read); lines, points and
/// free-form surfaces are skipped with a warning. Indices may name vertices further down.
namespace celadon::loaders {

/// @throws InputError with the line
[[nodiscard]] Scene loadObj(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
