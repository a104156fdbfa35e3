#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/load_json.h"

#include <filesystem>
#include <string>
#include <string_view>

/// Deformers in JSON, in a file of their own or in the extras of a glTF's scene. The format is in
/// renderer/scene/README.md.
namespace celadon::loaders {

/// The deformers of an object {"deformers": [...]}; none where it has no such member.
/// @throws InputError with the deformer and the member
[[nodiscard]] DeformerStack deformersOf(const JsonElement& owner);

/// A file that holds such an object. @throws InputError
[[nodiscard]] DeformerStack readDeformers(const std::filesystem::path& file);

/// The object, such that deformersOf() gives the same stack back.
[[nodiscard]] nlohmann::json deformersJson(const DeformerStack& stack);

/// The deformers of a document's scene from now on; none: they go.
/// @param file that it was read from, for messages
/// @throws InputError: it has no scene
void putDeformers(nlohmann::json& document, const std::filesystem::path& file,
                  const DeformerStack& stack);

/// A .gltf or .glb, as it is but for the deformers of its scene. Buffers and pictures beside the
/// file are named as they were.
/// @param content of the model file
/// @throws InputError: no glTF
[[nodiscard]] std::string gltfWithDeformers(const std::filesystem::path& file,
                                            std::string_view content, const DeformerStack& stack);

} // namespace celadon::loaders
