#include "app/plot/chart.h"
#include "app/plot/font.h"
#include "app/plot/frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace celadon::plot {

namespace {

/// Liang and Barsky 1984: the part of a piece within the area, if any.
std::optional<std::pair<glm::dvec2, glm::dvec2>> clip(const glm::dvec2& a, const glm::dvec2& b,
                                                      const PlotArea& area) {
    double first = 0.0;
    double last = 1.0;
    const glm::dvec2 along = b - a;
    const auto cut = [&](double direction, double room) {
        if (direction == 0.0) {
            return room >= 0.0;
        }
        const double t = room / direction;
        (direction < 0.0 ? first : last) = direction < 0.0 ? std::max(first, t) : std::min(last, t);
        return first <= last;
    };
    if (cut(-along.x, a.x - area.left) && cut(along.x, area.right - a.x) &&
        cut(-along.y, a.y - area.top) && cut(along.y, area.bottom - a.y)) {
        return std::pair{a + along * first, a + along * last};
    }
    return std::nullopt;
}

bool contains(const PlotArea& area, const glm::dvec2& point) {
    return point.x >= area.left && point.x <= area.right && point.y >= area.top &&
           point.y <= area.bottom;
}

void drawLine(Drawing& drawing, const PlotArea& area, const Scale& x, const Scale& y,
              const Series& series) {
    Stroke stroke{{}, series.color, series.width, series.dash};
    const auto finish = [&] {
        if (stroke.points.size() > 1) {
            drawing.shapes.emplace_back(stroke);
        }
        stroke.points.clear();
    };
    for (std::size_t i = 0; i + 1 < series.points.size(); ++i) {
        const glm::dvec2& from = series.points[i];
        const glm::dvec2& to = series.points[i + 1];
        if (!x.canShow(from.x) || !y.canShow(from.y) || !x.canShow(to.x) || !y.canShow(to.y)) {
            finish();
            continue;
        }
        const auto piece =
            clip({x.place(from.x), y.place(from.y)}, {x.place(to.x), y.place(to.y)}, area);
        if (!piece) {
            finish();
            continue;
        }
        if (!stroke.points.empty() && stroke.points.back() != piece->first) {
            finish();
        }
        if (stroke.points.empty()) {
            stroke.points.push_back(piece->first);
        }
        stroke.points.push_back(piece->second);
    }
    finish();
}

void drawDots(Drawing& drawing, const PlotArea& area, const Scale& x, const Scale& y,
              const Series& series) {
    constexpr double kHalf = 3.0;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
        const glm::dvec2& point = series.points[i];
        if (!x.canShow(point.x) || !y.canShow(point.y)) {
            continue;
        }
        const glm::dvec2 at(x.place(point.x), y.place(point.y));
        if (i < series.error.size() && at.x >= area.left && at.x <= area.right) {
            const double low = point.y - series.error[i];
            const double bottom = y.canShow(low) ? y.place(low) : area.bottom;
            const double top = y.place(point.y + series.error[i]);
            if (const auto piece = clip({at.x, bottom}, {at.x, top}, area)) {
                drawing.shapes.emplace_back(
                    Stroke{{piece->first, piece->second}, series.color, 1.0});
            }
        }
        if (series.hasDots && contains(area, at)) {
            drawing.shapes.emplace_back(
                Fill{{at + glm::dvec2(-kHalf, 0.0), at + glm::dvec2(0.0, -kHalf),
                      at + glm::dvec2(kHalf, 0.0), at + glm::dvec2(0.0, kHalf)},
                     series.color});
        }
    }
}

/// Draws the lines. @return their words, to be drawn over all other lines
std::vector<Shape> drawMarkers(Drawing& drawing, const PlotArea& area, const Scale& x,
                               const Scale& y, const std::vector<Marker>& markers) {
    double row = 0.0; // vertical markers' words take turns so that neighbors do not collide
    std::vector<Shape> words;
    for (const Marker& marker : markers) {
        const Scale& scale = marker.isHorizontal ? y : x;
        if (!scale.canShow(marker.value)) {
            continue;
        }
        const double at = scale.place(marker.value);
        const glm::dvec2 from =
            marker.isHorizontal ? glm::dvec2(area.left, at) : glm::dvec2(at, area.bottom);
        const glm::dvec2 to =
            marker.isHorizontal ? glm::dvec2(area.right, at) : glm::dvec2(at, area.top);
        if (!contains(area, from)) {
            continue;
        }
        drawing.shapes.emplace_back(Stroke{{from, to}, marker.color, 1.0, {4.0, 3.0}});
        if (marker.label.empty()) {
            continue;
        }
        if (marker.isHorizontal) {
            drawing.shapes.emplace_back(Text{{area.right - 6.0, at - 4.0},
                                             marker.label,
                                             kTickSize - 0.5,
                                             Align::Right,
                                             false,
                                             marker.color});
            continue;
        }
        const double width = textWidth(marker.label, kTickSize - 0.5);
        const bool isRightFree = at + 4.0 + width < area.right;
        const double left = isRightFree ? at + 2.0 : at - 6.0 - width;
        const double base = area.bottom - 8.0 - row;
        words.emplace_back(Fill{{{left, base - kTickSize + 1.0},
                                 {left + width + 4.0, base - kTickSize + 1.0},
                                 {left + width + 4.0, base + 3.0},
                                 {left, base + 3.0}},
                                Color(1.0f),
                                0.85});
        words.emplace_back(Text{{at + (isRightFree ? 4.0 : -4.0), base},
                                marker.label,
                                kTickSize - 0.5,
                                isRightFree ? Align::Left : Align::Right,
                                false,
                                marker.color});
        row = row > 60.0 ? 0.0 : row + kTickSize + 3.0;
    }
    return words;
}

} // namespace

Drawing drawChart(const LineChart& chart) {
    std::vector<double> xs;
    std::vector<double> ys;
    for (const Series& series : chart.series) {
        for (const glm::dvec2& point : series.points) {
            xs.push_back(point.x);
            ys.push_back(point.y);
        }
    }
    Scale x(chart.x, xs, 0.0, 1.0, false);
    Scale y(chart.y, ys, 1.0, 0.0, true);
    const PlotArea area = makeArea(chart.size, chart.title, y, chart.x.label, chart.y.label);
    x.setEnds(area.left, area.right);
    y.setEnds(area.bottom, area.top);

    Drawing drawing{chart.size, {}};
    drawXAxis(drawing, area, x, chart.x.label);
    drawYAxis(drawing, area, y, chart.y.label);
    std::vector<Shape> words = drawMarkers(drawing, area, x, y, chart.markers);
    std::vector<LegendEntry> entries;
    for (const Series& series : chart.series) {
        if (series.hasLine) {
            drawLine(drawing, area, x, y, series);
        }
        drawDots(drawing, area, x, y, series);
        if (!series.label.empty()) {
            entries.push_back({series.label, series.color, series.hasLine ? series.width : 0.0,
                               series.dash, series.hasDots, false});
        }
    }
    std::ranges::move(words, std::back_inserter(drawing.shapes));
    drawBorder(drawing, area);
    drawTitle(drawing, area, chart.title);
    drawLegend(drawing, area, entries, chart.legend);
    return drawing;
}

Color seriesColor(std::size_t i) {
    constexpr Color kColors[] = {{0.0f, 0.0f, 0.0f},       {0.0f, 0.447f, 0.698f},
                                 {0.835f, 0.369f, 0.0f},   {0.0f, 0.62f, 0.451f},
                                 {0.8f, 0.475f, 0.655f},   {0.902f, 0.624f, 0.0f},
                                 {0.337f, 0.706f, 0.914f}, {0.55f, 0.55f, 0.1f}};
    return kColors[i % std::size(kColors)];
}

Color channelColor(int channel) {
    constexpr Color kColors[] = {
        {0.80f, 0.14f, 0.14f}, {0.10f, 0.55f, 0.20f}, {0.12f, 0.30f, 0.78f}};
    return kColors[channel];
}

} // namespace celadon::plot
