#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

/// Puts materials into glTF documents that others have made: what the new material does not speak
/// of (textures, normal map, other extensions) stays.
namespace celadon::loaders {

/// In the place of a material of a document, which keeps its name and what `made` does not speak
/// of; the extensions are listed as used. An index one beyond the last: a new material, worn by all
/// meshes that have none.
void mergeGltfMaterial(nlohmann::json& document, std::size_t material, const nlohmann::json& made);

/// The same for a document not checked before.
/// @param file     that the document was read from, for messages
/// @param material index or name; empty: all materials, and one for meshes that have none
/// @throws InputError if there is no such material, or the document is not glTF 2.0
void mergeGltfMaterial(nlohmann::json& document, const std::string& file,
                       const std::string& material, const nlohmann::json& made);

} // namespace celadon::loaders
