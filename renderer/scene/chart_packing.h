#pragma once

#include <glm/vec2.hpp>

#include <vector>

/// Places the rectangles of a builtin sculpture's charts into one square.
namespace celadon {

struct ChartPacking {
    std::vector<glm::dvec2> corners; ///< top left of each rectangle, in the order given
    double side = 0.0;               ///< of the square
};

/// Shelves of falling height; the square is the smallest of those tried. Deterministic.
/// @param sizes  width and height of each rectangle, > 0
/// @param margin between rectangles, and to the border
[[nodiscard]] ChartPacking packCharts(const std::vector<glm::dvec2>& sizes, double margin);

} // namespace celadon
