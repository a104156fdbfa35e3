#pragma once

#include <glm/vec2.hpp>

#include <string_view>
#include <vector>

/// The font of all plots, DejaVu Sans, compiled into the program.
namespace celadon::plot {

inline constexpr const char* kFontFamily = "DejaVu Sans";

/// Width of a line of UTF-8 text.
[[nodiscard]] double textWidth(std::string_view text, double size);

/// Outlines of the text as closed polygons, filled where they wind around (nonzero rule); the
/// baseline starts at the origin, y down.
[[nodiscard]] std::vector<std::vector<glm::dvec2>> textOutlines(std::string_view text, double size);

} // namespace celadon::plot
