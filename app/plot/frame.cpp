#include "app/plot/frame.h"

#include "app/plot/font.h"

#include <algorithm>

namespace celadon::plot {

namespace {

constexpr Color kInk{0.13f};
constexpr Color kMajorGrid{0.87f};
constexpr Color kMinorGrid{0.94f};
constexpr double kTickLength = 5.0;

void drawLine(Drawing& drawing, glm::dvec2 from, glm::dvec2 to, const Color& color, double width) {
    drawing.shapes.emplace_back(Stroke{{from, to}, color, width});
}

} // namespace

PlotArea makeArea(const glm::dvec2& size, const std::string& title, const Scale& y,
                  const std::string& xLabel, const std::string& yLabel) {
    double widest = 0.0;
    for (const Tick& tick : y.ticks()) {
        widest = std::max(widest, textWidth(tick.label, kTickSize));
    }
    return {16.0 + widest + kTickLength + (yLabel.empty() ? 0.0 : kLabelSize + 8.0), size.x - 20.0,
            title.empty() ? 16.0 : 24.0 + kTitleSize, size.y - (xLabel.empty() ? 28.0 : 50.0)};
}

void drawTitle(Drawing& drawing, const PlotArea& area, const std::string& title) {
    if (!title.empty()) {
        // A title too long for the plot gets smaller rather than cut.
        const double width = textWidth(title, kTitleSize);
        const double room = drawing.size.x - 24.0;
        const double size = kTitleSize * std::min(1.0, room / std::max(width, 1.0));
        const double center =
            std::clamp(0.5 * (area.left + area.right), 12.0 + 0.5 * std::min(width, room),
                       drawing.size.x - 12.0 - 0.5 * std::min(width, room));
        drawing.shapes.emplace_back(
            Text{{center, area.top - 12.0}, title, size, Align::Center, false, kInk});
    }
}

void drawXAxis(Drawing& drawing, const PlotArea& area, const Scale& x, const std::string& label) {
    double lastEnd = -1e9;
    for (const Tick& tick : x.ticks()) {
        const double at = x.place(tick.value);
        const bool isMajor = !tick.label.empty();
        drawLine(drawing, {at, area.top}, {at, area.bottom}, isMajor ? kMajorGrid : kMinorGrid,
                 isMajor ? 1.0 : 0.6);
        drawLine(drawing, {at, area.bottom},
                 {at, area.bottom + (isMajor ? kTickLength : 0.5 * kTickLength)}, kInk, 0.9);
        const double half = 0.5 * textWidth(tick.label, kTickSize);
        if (isMajor && at - half > lastEnd + 6.0) {
            drawing.shapes.emplace_back(Text{{at, area.bottom + kTickLength + kTickSize + 2.0},
                                             tick.label,
                                             kTickSize,
                                             Align::Center,
                                             false,
                                             kInk});
            lastEnd = at + half;
        }
    }
    if (!label.empty()) {
        drawing.shapes.emplace_back(Text{{0.5 * (area.left + area.right), area.bottom + 41.0},
                                         label,
                                         kLabelSize,
                                         Align::Center,
                                         false,
                                         kInk});
    }
}

void drawYAxis(Drawing& drawing, const PlotArea& area, const Scale& y, const std::string& label) {
    for (const Tick& tick : y.ticks()) {
        const double at = y.place(tick.value);
        const bool isMajor = !tick.label.empty();
        drawLine(drawing, {area.left, at}, {area.right, at}, isMajor ? kMajorGrid : kMinorGrid,
                 isMajor ? 1.0 : 0.6);
        drawLine(drawing, {area.left - (isMajor ? kTickLength : 0.5 * kTickLength), at},
                 {area.left, at}, kInk, 0.9);
        if (isMajor) {
            drawing.shapes.emplace_back(Text{{area.left - kTickLength - 3.0, at + 0.36 * kTickSize},
                                             tick.label,
                                             kTickSize,
                                             Align::Right,
                                             false,
                                             kInk});
        }
    }
    if (!label.empty()) {
        drawing.shapes.emplace_back(Text{{kLabelSize + 6.0, 0.5 * (area.top + area.bottom)},
                                         label,
                                         kLabelSize,
                                         Align::Center,
                                         true,
                                         kInk});
    }
}

void drawBorder(Drawing& drawing, const PlotArea& area) {
    drawing.shapes.emplace_back(Stroke{{{area.left, area.top},
                                        {area.right, area.top},
                                        {area.right, area.bottom},
                                        {area.left, area.bottom},
                                        {area.left, area.top}},
                                       kInk,
                                       1.0});
}

void drawLegend(Drawing& drawing, const PlotArea& area, const std::vector<LegendEntry>& entries,
                Legend place) {
    if (entries.empty() || place == Legend::None) {
        return;
    }
    constexpr double kPadding = 8.0;
    constexpr double kSample = 26.0;
    constexpr double kRow = 18.0;
    double widest = 0.0;
    for (const LegendEntry& entry : entries) {
        widest = std::max(widest, textWidth(entry.label, kTickSize));
    }
    const double width = kPadding * 3.0 + kSample + widest;
    const double height = kPadding * 2.0 + kRow * static_cast<double>(entries.size()) - 4.0;
    const bool isLeft = place == Legend::TopLeft || place == Legend::BottomLeft;
    const bool isTop = place == Legend::TopLeft || place == Legend::TopRight;
    const double x = isLeft ? area.left + 10.0 : area.right - 10.0 - width;
    const double y = isTop ? area.top + 10.0 : area.bottom - 10.0 - height;
    const std::vector<glm::dvec2> box{
        {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}, {x, y}};
    drawing.shapes.emplace_back(Fill{box, Color(1.0f), 0.88});
    drawing.shapes.emplace_back(Stroke{box, Color(0.75f), 0.8});
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const LegendEntry& entry = entries[i];
        const double middle = y + kPadding + kRow * (static_cast<double>(i) + 0.5) - 2.0;
        const double from = x + kPadding;
        if (entry.isBar) {
            drawing.shapes.emplace_back(Fill{{{from + 6.0, middle - 5.0},
                                              {from + 20.0, middle - 5.0},
                                              {from + 20.0, middle + 5.0},
                                              {from + 6.0, middle + 5.0}},
                                             entry.color});
        } else if (entry.width > 0.0) {
            drawing.shapes.emplace_back(Stroke{
                {{from, middle}, {from + kSample, middle}}, entry.color, entry.width, entry.dash});
        }
        if (entry.hasDot) {
            const glm::dvec2 center(from + 0.5 * kSample, middle);
            drawing.shapes.emplace_back(
                Fill{{center + glm::dvec2(-3.0, 0.0), center + glm::dvec2(0.0, -3.0),
                      center + glm::dvec2(3.0, 0.0), center + glm::dvec2(0.0, 3.0)},
                     entry.color});
        }
        drawing.shapes.emplace_back(Text{{from + kSample + kPadding, middle + 0.36 * kTickSize},
                                         entry.label,
                                         kTickSize,
                                         Align::Left,
                                         false,
                                         kInk});
    }
}

} // namespace celadon::plot
