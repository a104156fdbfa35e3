#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <variant>
#include <vector>

/// A picture as a list of shapes, in units of 1/96 inch with y down: what charts are turned into,
/// and what is written as SVG or drawn into pixels.
namespace celadon::plot {

using Color = glm::vec3; ///< sRGB encoded, 0..1

enum class Align { Left, Center, Right };

/// An open line.
struct Stroke {
    std::vector<glm::dvec2> points;
    Color color{0.0f};
    double width = 1.0;
    std::vector<double> dash{}; ///< lengths of stroke and gap, in turn; empty: solid
    double opacity = 1.0;
};

/// A filled polygon.
struct Fill {
    std::vector<glm::dvec2> points;
    Color color{0.0f};
    double opacity = 1.0;
};

struct Text {
    glm::dvec2 position; ///< on the baseline
    std::string text;    ///< UTF-8
    double size = 12.0;  ///< of the font
    Align align = Align::Left;
    bool isVertical = false; ///< reads upwards
    Color color{0.0f};
};

using Shape = std::variant<Stroke, Fill, Text>;

struct Drawing {
    glm::dvec2 size{800.0, 600.0};
    std::vector<Shape> shapes; ///< later ones cover earlier ones
};

/// Panels in a row, aligned at the top.
[[nodiscard]] Drawing placeBeside(const std::vector<Drawing>& panels);

} // namespace celadon::plot
