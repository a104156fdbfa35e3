#pragma once

#include "renderer/scene/scene.h"

#include <filesystem>

/// Reads a model file: .gltf .glb .obj .ply .off .stl by its extension (any case).
/// What the file says is checked before any library sees it: sizes, counts, index ranges, numbers.
namespace celadon {

/// Normals: from the file; missing ones are flat for glTF (vertices split), angle-weighted over
/// vertices at equal positions otherwise. UVs: as in the file (OBJ, PLY flipped to v down), else
/// empty.
/// @throws InputError with file, place and reason; never returns a scene without triangles
[[nodiscard]] Scene loadScene(const std::filesystem::path& file);

/// By its name, as loadScene() tells formats apart.
[[nodiscard]] bool isGltf(const std::filesystem::path& file);

} // namespace celadon
