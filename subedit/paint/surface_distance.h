#pragma once

#include "subedit/paint/surface.h"

#include <limits>
#include <span>
#include <vector>

/// Distances along the surface, over the graph of neighboring texels (Dijkstra 1959): at most 8 %
/// too long, where the way lies between the eight directions of a grid.
namespace celadon::subedit {

inline constexpr float kUnreached = std::numeric_limits<float>::infinity();

/// @param sources covered texels, at distance 0; others are ignored
/// @return        mm for every texel of the map; kUnreached beyond `withinMm` and on background
[[nodiscard]] std::vector<float>
surfaceDistanceMm(const Surface& surface, std::span<const Surface::Texel> sources, float withinMm);

} // namespace celadon::subedit
