#pragma once

#include "renderer/scene/world.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace celadon {

/// Writes a world at rest as glTF 2.0: FILE.gltf, and FILE.bin beside it, in meters. Positions,
/// normals and the first texture coordinates are those of the world, so that a map that was painted
/// on an automatic atlas fits. Opaque parts keep base color, metalness, roughness and emission;
/// their textures, skins and animations are left out.
/// @param scattering of each of World::materials: a glTF material, with `extras.subedit`
/// @param extras    of the scene: deformers, in meters
/// @throws OutputError; files that were there before are then untouched, or whole and new
void writeGltf(const World& world, const std::vector<nlohmann::json>& scattering,
               const nlohmann::json& extras, const std::filesystem::path& file);

} // namespace celadon
