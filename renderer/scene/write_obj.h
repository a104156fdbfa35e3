#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>
#include <span>

namespace celadon {

/// Writes meshes as one Wavefront OBJ file: an object per mesh, positions in model units, normals
/// and the first texture coordinates where a mesh has them, v up as OBJ has it. Numbers keep all
/// digits of a float. The file appears when it is complete.
/// @throws OutputError; a file that was there before is then untouched
void writeObj(std::span<const Mesh* const> meshes, const std::filesystem::path& file);
void writeObj(const Scene& scene, const std::filesystem::path& file);

} // namespace celadon
