#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

/// Uniform blocks, from the same file that the shaders include: std140 and C++ agree because only
/// mat4, vec4 and ivec4 occur.
namespace celadon::blocks {

using glm::ivec4;
using glm::mat4;
using glm::vec4;

#include "shaders/include/blocks.glsl"

static_assert(sizeof(FrameBlock) == 2 * 64 + 4 * 16);
static_assert(sizeof(BoundsBlock) == 2 * 16);
static_assert(sizeof(LightBlock) == 2 * 64 + 4 * 16);
static_assert(sizeof(MaterialEntry) == 3 * 16);
static_assert(sizeof(SolveBlock) == 4 * 16);

/// Binding points, as in shaders/include/*.glsl.
enum Binding : unsigned { kFrame = 0, kLight = 1, kMaterials = 2, kSolve = 3, kBounds = 4 };

} // namespace celadon::blocks
