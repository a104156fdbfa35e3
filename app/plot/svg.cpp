#include "app/plot/svg.h"

#include "app/plot/font.h"

#include <fmt/format.h>

#include <cmath>

namespace celadon::plot {

namespace {

std::string hex(const Color& color) {
    const auto byte = [](float value) {
        return static_cast<int>(std::lround(255.0f * std::min(std::max(value, 0.0f), 1.0f)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.r), byte(color.g), byte(color.b));
}

std::string escape(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            // XML has no other control characters.
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return out;
}

std::string pointList(const std::vector<glm::dvec2>& points) {
    std::string out;
    for (const glm::dvec2& point : points) {
        out += fmt::format("{}{:.2f},{:.2f}", out.empty() ? "" : " ", point.x, point.y);
    }
    return out;
}

std::string element(const Stroke& stroke) {
    std::string dash;
    for (const double length : stroke.dash) {
        dash += fmt::format("{}{:g}", dash.empty() ? "" : ",", length);
    }
    return fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\"{}{} "
        "stroke-linejoin=\"round\"/>\n",
        pointList(stroke.points), hex(stroke.color), stroke.width,
        dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash),
        stroke.opacity < 1.0 ? fmt::format(" stroke-opacity=\"{:g}\"", stroke.opacity) : "");
}

std::string element(const Fill& fill) {
    return fmt::format(
        "<polygon points=\"{}\" fill=\"{}\"{}/>\n", pointList(fill.points), hex(fill.color),
        fill.opacity < 1.0 ? fmt::format(" fill-opacity=\"{:g}\"", fill.opacity) : "");
}

std::string element(const Text& text) {
    const char* anchor = text.align == Align::Left     ? "start"
                         : text.align == Align::Center ? "middle"
                                                       : "end";
    const std::string place =
        text.isVertical
            ? fmt::format("transform=\"translate({:.2f} {:.2f}) rotate(-90)\"", text.position.x,
                          text.position.y)
            : fmt::format("x=\"{:.2f}\" y=\"{:.2f}\"", text.position.x, text.position.y);
    return fmt::format("<text {} font-size=\"{:g}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                       place, text.size, anchor, hex(text.color), escape(text.text));
}

} // namespace

std::string toSvg(const Drawing& drawing) {
    std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
                    "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"{2}, Verdana, sans-serif\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
                    drawing.size.x, drawing.size.y, kFontFamily);
    for (const Shape& shape : drawing.shapes) {
        svg += std::visit([](const auto& one) { return element(one); }, shape);
    }
    return svg + "</svg>\n";
}

} // namespace celadon::plot
