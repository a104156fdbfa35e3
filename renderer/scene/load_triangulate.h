#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// One polygon in space, not necessarily planar or convex, cut into triangles.
namespace celadon::loaders {

/// Polygons with more corners than this must be convex: ear clipping is quadratic.
inline constexpr std::size_t kMaxConcaveCorners = 4096;

/// n - 2 triangles of positions in `corners` (0 ... n - 1), in the polygon's own winding, appended
/// to `triangles`. A quad is split along the diagonal that lies inside, of two such the shorter; a
/// convex polygon is a fan; any other loses its ears (Meisters 1975) in the projection along its
/// Newell normal. A polygon that crosses itself gives some set of n - 2 triangles.
/// @param corners at least three
/// @return false when it has too many corners for what it is; nothing is appended then
[[nodiscard]] bool triangulate(std::span<const glm::vec3> corners,
                               std::vector<std::array<std::uint32_t, 3>>& triangles);

} // namespace celadon::loaders
