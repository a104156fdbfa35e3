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

/// What one element of an accessor is made of.
struct GltfElement {
    int components = 0;
    int componentBytes = 0;
    int columns = 1;                        ///< of a matrix; its columns start at multiples of 4
    [[nodiscard]] int bytes() const;        ///< of the element, tightly packed
    [[nodiscard]] int columnStride() const; ///< bytes from one column to the next
};

/// `type` as glTF has it ("VEC3"), `componentType` as GL has it (5126); zeros when unknown.
[[nodiscard]] GltfElement gltfElement(const std::string& type, std::int64_t componentType);

/// Version 2, and extensions that are required are among those we have.
/// @throws InputError that names every one we lack
void checkGltfVersion(const JsonElement& root);

/// Extensions of the file that are ignored and change what is seen, as warnings.
[[nodiscard]] std::vector<std::string> unsupportedExtensions(const JsonElement& root);

/// @param bufferSizes of each buffer, as it was found to be (at least its byteLength)
/// @throws InputError with the element
void checkGltf(const JsonElement& root, std::span<const std::uint64_t> bufferSizes);

} // namespace celadon::loaders
