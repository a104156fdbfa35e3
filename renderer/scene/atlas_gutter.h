#pragma once

#include "renderer/scene/scene.h"

#include <span>
#include <vector>

namespace celadon {

/// Texels beyond the gutter that maps are filled for.
inline constexpr int kDefaultDilationTexels = 16;

/// Where each texel of a map takes its value from, so that filtering at a chart border sees that
/// chart and neither the background nor another chart (DESIGN section 2).
/// A texel is covered when a triangle holds its center; a triangle so small that it holds none
/// covers the texel its center of gravity is in. Coordinates outside [0, 1] repeat.
/// @return [height][width]: the texel's own index if covered, else the index of the nearest covered
///         one no farther than `radiusTexels` (ties: the smallest index), else -1
[[nodiscard]] std::vector<int> dilationSource(std::span<const Mesh* const> meshes, int width,
                                              int height,
                                              int radiusTexels = kDefaultDilationTexels);

} // namespace celadon
