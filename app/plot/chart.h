#pragma once

#include "app/plot/drawing.h"

#include <optional>
#include <string>
#include <vector>

/// Charts for people who read papers: lines over linear or logarithmic axes, and bars.
namespace celadon::plot {

struct Axis {
    std::string label;
    bool isLogarithmic = false;
    /// Ends of the axis; unset ones follow the data.
    std::optional<double> from{}, to{};
};

struct Series {
    std::string label; ///< in the legend; empty: not listed
    std::vector<glm::dvec2> points;
    Color color{0.0f};
    double width = 1.8;
    std::vector<double> dash{};
    bool hasDots = false; ///< a dot at each point
    bool hasLine = true;
    std::vector<double> error{}; ///< half lengths of error bars, one a point, or empty
};

/// A line across the plot at one value, with a word beside it.
struct Marker {
    double value;
    std::string label;
    Color color{0.4f};
    bool isHorizontal = false;
};

enum class Legend { TopRight, TopLeft, BottomLeft, BottomRight, None };

struct LineChart {
    std::string title;
    Axis x, y;
    std::vector<Series> series;
    std::vector<Marker> markers{};
    Legend legend = Legend::TopRight;
    glm::dvec2 size{640.0, 480.0};
};

struct BarSeries {
    std::string label;
    Color color{0.0f};
    std::vector<double> values; ///< one a group; NaN leaves a gap
};

struct BarChart {
    std::string title;
    std::vector<std::string> groups;
    Axis y;
    std::vector<BarSeries> series;
    std::string valueFormat{}; ///< of fmt, such as "{:.2f}", written over each bar; empty: none
    Legend legend = Legend::TopRight;
    glm::dvec2 size{640.0, 480.0};
};

/// Points that are not finite, or not positive on a logarithmic axis, interrupt their line; what
/// lies outside of the axes is cut off.
[[nodiscard]] Drawing drawChart(const LineChart& chart);
[[nodiscard]] Drawing drawChart(const BarChart& chart);

/// Color i of a sequence that color-blind people can tell apart (Okabe, Ito 2008); repeats after 8.
[[nodiscard]] Color seriesColor(std::size_t i);

/// Red, green and blue that print well, for the channels of a profile.
[[nodiscard]] Color channelColor(int channel);

} // namespace celadon::plot
