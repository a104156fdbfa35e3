#pragma once

#include "renderer/scene/world.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>
#include <vector>

/// Where each material of a scene lies in the one array texture that holds them all
/// (shaders/include/material.glsl). No GL here.
namespace celadon {

/// Width, height and knots of each map.
[[nodiscard]] std::vector<glm::ivec3> sizesOf(std::span<const MaterialPointer> materials);

struct MaterialSlots {
    std::vector<glm::ivec3> origins; ///< left, top, first layer of each, in the order given
    glm::ivec3 extent{0};            ///< of the array that holds them
};

/// Deterministic. Materials of equal depth lie side by side, on shelves; one that is shallow fills
/// the layers that another leaves free. No two share a texel of a layer.
/// @param sizes width, height and layers of each, > 0
[[nodiscard]] MaterialSlots arrangeMaterials(std::span<const glm::ivec3> sizes);

} // namespace celadon
