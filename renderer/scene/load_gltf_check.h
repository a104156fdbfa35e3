#pragma once

#include "renderer/scene/load_json.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Holds every number of a glTF that is used later against the data and against the others, so that
/// readers may trust them: indices, ranges of bytes in 64-bit arithmetic, types, counts, the tree
/// of nodes, cones and angles.
namespace celadon::loaders {

/// Version 2, and extensions that are required are among those we have.
/// @throws InputError that names every one we lack
void checkGltfVersion(const JsonElement& root);

/// Extensions of the file that are ignored and change what is seen, as warnings.
[[nodiscard]] std::vector<std::string> unsupportedExtensions(const JsonElement& root);

/// @param bufferSizes of each buffer, as it was found to be (at least its byteLength)
/// @throws InputError with the element
void checkGltf(const JsonElement& root, std::span<const std::uint64_t> bufferSizes);

} // namespace celadon::loaders
