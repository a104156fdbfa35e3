#pragma once

#include "renderer/scene/gltf_lights.h"
#include "renderer/scene/world.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <span>
#include <vector>

namespace celadon {

/// Writes a world at rest as glTF 2.0, in meters: FILE.glb, or FILE.gltf with FILE.bin beside it.
/// Positions, normals and texture coordinates are those of the world, so that a map that was
/// painted on an automatic atlas fits. Looks keep what Celadon reads of them, textures (as PNG)
/// included; skins, animations and cameras are left out.
/// @param scattering of each of World::materials: a glTF material, with `extras.subedit`; textures
///                   of the look that a part has besides join it
/// @param extras    of the scene: deformers, in meters
/// @param lights    positions in meters
/// @throws OutputError; files that were there before are then untouched
void writeGltf(const World& world, const std::vector<nlohmann::json>& scattering,
               const nlohmann::json& extras, const std::filesystem::path& file,
               std::span<const loaders::NamedLight> lights = {});

} // namespace celadon
