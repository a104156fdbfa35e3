#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string_view>

/// Stanford PLY 1.0: ascii, binary little and big endian. Of the vertices x y z, nx ny nz and
/// texture coordinates (s t, u v, texture_u texture_v; v up in the file); of the faces
/// vertex_indices and a texcoord list per face; triangle strips. Other elements and properties are
/// skipped. Counts are held against the size of the file before anything is allocated.
namespace celadon::loaders {

/// @throws InputError with the line, or the number of the vertex or face
[[nodiscard]] Scene loadPly(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
