#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <string_view>

/// Stereolithography, ascii and binary. Facet normals and attributes are ignored; corners at equal
/// positions become one vertex, so that the surface is connected and shaded smoothly.
namespace celadon::loaders {

/// @throws InputError with the line, or the number of the vertex or face
[[nodiscard]] Scene loadStl(const std::filesystem::path& file, std::string_view content);

} // namespace celadon::loaders
