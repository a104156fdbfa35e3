#pragma once

#include "app/plot/scale.h"

#include <string>
#include <vector>

/// What line and bar charts share: title, axes with ticks and grid, legend.
namespace celadon::plot {

inline constexpr double kTitleSize = 15.0;
inline constexpr double kLabelSize = 13.0;
inline constexpr double kTickSize = 11.5;

struct LegendEntry {
    std::string label;
    Color color;
    double width;
    std::vector<double> dash;
    bool hasDot;
    bool isBar;
};

struct PlotArea {
    double left, right, top, bottom;
};

/// Room for everything around the plot, given the widest label of the y axis.
[[nodiscard]] PlotArea makeArea(const glm::dvec2& size, const std::string& title, const Scale& y,
                                const std::string& xLabel, const std::string& yLabel);

void drawTitle(Drawing& drawing, const PlotArea& area, const std::string& title);
void drawXAxis(Drawing& drawing, const PlotArea& area, const Scale& x, const std::string& label);
void drawYAxis(Drawing& drawing, const PlotArea& area, const Scale& y, const std::string& label);
/// The frame's lines, over grid and data.
void drawBorder(Drawing& drawing, const PlotArea& area);
void drawLegend(Drawing& drawing, const PlotArea& area, const std::vector<LegendEntry>& entries,
                Legend place);

} // namespace celadon::plot
