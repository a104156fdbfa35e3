#include "app/plot/chart.h"
#include "app/plot/font.h"
#include "app/plot/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace celadon::plot {

namespace {

constexpr double kGroupFill = 0.78; ///< part of a group's room that bars take

/// A word that would collide with its neighbors is set smaller.
void drawGroupLabel(Drawing& drawing, const PlotArea& area, double center, double room,
                    const std::string& label) {
    const double width = textWidth(label, kTickSize);
    const double size = kTickSize * std::min(1.0, (room - 4.0) / std::max(width, 1.0));
    drawing.shapes.emplace_back(Text{{center, area.bottom + kTickSize + 6.0},
                                     label,
                                     std::max(size, 6.0),
                                     Align::Center,
                                     false,
                                     Color(0.13f)});
}

} // namespace

Drawing drawChart(const BarChart& chart) {
    std::vector<double> values;
    if (!chart.y.isLogarithmic) {
        values.push_back(0.0); // bars stand on zero
    }
    for (const BarSeries& series : chart.series) {
        values.insert(values.end(), series.values.begin(), series.values.end());
    }
    Scale y(chart.y, values, 1.0, 0.0, true);
    const PlotArea area = makeArea(chart.size, chart.title, y, "", chart.y.label);
    y.setEnds(area.bottom, area.top);
    Drawing drawing{chart.size, {}};
    drawYAxis(drawing, area, y, chart.y.label);

    const double groupRoom = (area.right - area.left) /
                             static_cast<double>(std::max<std::size_t>(chart.groups.size(), 1));
    const double barWidth =
        kGroupFill * groupRoom / static_cast<double>(std::max<std::size_t>(chart.series.size(), 1));
    const double ground = chart.y.isLogarithmic ? area.bottom : y.place(std::max(y.from(), 0.0));
    std::vector<LegendEntry> entries;
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
        const BarSeries& series = chart.series[s];
        for (std::size_t g = 0; g < std::min(chart.groups.size(), series.values.size()); ++g) {
            if (!y.canShow(series.values[g])) {
                continue;
            }
            const double left = area.left +
                                groupRoom * (static_cast<double>(g) + 0.5 * (1.0 - kGroupFill)) +
                                barWidth * static_cast<double>(s);
            const double top = std::clamp(y.place(series.values[g]), area.top, area.bottom);
            drawing.shapes.emplace_back(Fill{{{left, ground},
                                              {left + 0.92 * barWidth, ground},
                                              {left + 0.92 * barWidth, top},
                                              {left, top}},
                                             series.color});
            if (!chart.valueFormat.empty()) {
                const std::string text =
                    fmt::format(fmt::runtime(chart.valueFormat), series.values[g]);
                const double size = std::min(kTickSize - 1.5, (kTickSize - 1.5) * (barWidth + 6.0) /
                                                                  textWidth(text, kTickSize - 1.5));
                drawing.shapes.emplace_back(Text{{left + 0.46 * barWidth, top - 4.0},
                                                 text,
                                                 size,
                                                 Align::Center,
                                                 false,
                                                 Color(0.13f)});
            }
        }
        if (!series.label.empty()) {
            entries.push_back({series.label, series.color, 1.0, {}, false, true});
        }
    }
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
        drawGroupLabel(drawing, area, area.left + groupRoom * (static_cast<double>(g) + 0.5),
                       groupRoom, chart.groups[g]);
    }
    drawBorder(drawing, area);
    drawTitle(drawing, area, chart.title);
    drawLegend(drawing, area, entries, chart.legend);
    return drawing;
}

} // namespace celadon::plot
