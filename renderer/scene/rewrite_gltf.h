#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/gltf_lights.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A glTF file with other materials, deformers and lights, and all else as it is: nodes, skins,
/// morph targets, animations, cameras, textures (but for the base color of what gets a new
/// material), and what Celadon does not know. Buffers and pictures, wherever they were, go into the
/// one buffer of the new file, which may lie anywhere.
namespace celadon::loaders {

struct GltfChanges {
    /// By index in the file, to be merged; one beyond the last: for meshes that wear none.
    std::map<std::size_t, nlohmann::json> materials;
    DeformerStack deformers; ///< of the scene, in units of the new file
    double scale = 1.0;      ///< of everything
    /// Instead of the file's, in units of the new one; nothing: these stay.
    std::optional<std::vector<NamedLight>> lights = std::nullopt;
};

/// @return what had to stay behind, a line each
/// @throws InputError: `source` is no glTF that Celadon reads; UsageError: a buffer of the source
/// would be replaced; OutputError as writeGltfFile()
std::vector<std::string> rewriteGltf(const std::filesystem::path& source,
                                     const GltfChanges& changes,
                                     const std::filesystem::path& target);

} // namespace celadon::loaders
