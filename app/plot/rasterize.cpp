#include "app/plot/rasterize.h"

#include "app/plot/font.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::plot {

namespace {

using Contour = std::vector<glm::dvec2>;
constexpr int kSubRows = 8; ///< samples of coverage per pixel row; exact along the row

class Canvas {
public:
    Canvas(int width, int height)
        : mWidth(width),
          mHeight(height),
          mPixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Color(1.0f)) {
    }

    /// Fills where the contours, in pixels, wind around.
    void fill(const std::vector<Contour>& contours, const Color& color, double opacity) {
        std::vector<std::vector<Edge>> rows(static_cast<std::size_t>(mHeight));
        for (const Contour& contour : contours) {
            for (std::size_t i = 0; i < contour.size(); ++i) {
                addEdge(rows, contour[i], contour[(i + 1) % contour.size()]);
            }
        }
        std::vector<float> coverage(static_cast<std::size_t>(mWidth));
        for (int y = 0; y < mHeight; ++y) {
            const std::vector<Edge>& edges = rows[static_cast<std::size_t>(y)];
            if (edges.empty()) {
                continue;
            }
            std::ranges::fill(coverage, 0.0f);
            for (int sub = 0; sub < kSubRows; ++sub) {
                coverRow(edges, y + (sub + 0.5) / kSubRows, coverage);
            }
            blend(y, coverage, color, static_cast<float>(opacity));
        }
    }

    [[nodiscard]] const std::vector<Color>& pixels() const { return mPixels; }

private:
    struct Edge {
        glm::dvec2 top, bottom;
        int winding; ///< 1 downwards, -1 upwards
    };

    void addEdge(std::vector<std::vector<Edge>>& rows, const glm::dvec2& a,
                 const glm::dvec2& b) const {
        if (a.y == b.y) {
            return;
        }
        const Edge edge = a.y < b.y ? Edge{a, b, 1} : Edge{b, a, -1};
        const int first = static_cast<int>(std::floor(std::max(edge.top.y, 0.0)));
        const int last =
            static_cast<int>(std::floor(std::min(edge.bottom.y, static_cast<double>(mHeight - 1))));
        for (int y = first; y <= last; ++y) {
            rows[static_cast<std::size_t>(y)].push_back(edge);
        }
    }

    void coverRow(const std::vector<Edge>& edges, double y, std::vector<float>& coverage) const {
        struct Crossing {
            double x;
            int winding;
        };
        std::vector<Crossing> crossings;
        for (const Edge& edge : edges) {
            if (edge.top.y <= y && y < edge.bottom.y) {
                const double t = (y - edge.top.y) / (edge.bottom.y - edge.top.y);
                crossings.push_back({edge.top.x + (edge.bottom.x - edge.top.x) * t, edge.winding});
            }
        }
        std::ranges::sort(crossings, {}, &Crossing::x);
        int winding = 0;
        for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
            winding += crossings[i].winding;
            if (winding != 0) {
                coverSpan(crossings[i].x, crossings[i + 1].x, coverage);
            }
        }
    }

    void coverSpan(double from, double to, std::vector<float>& coverage) const {
        from = std::clamp(from, 0.0, static_cast<double>(mWidth));
        to = std::clamp(to, 0.0, static_cast<double>(mWidth));
        for (int x = static_cast<int>(from); x < to; ++x) {
            const double part = std::min(to, x + 1.0) - std::max(from, static_cast<double>(x));
            coverage[static_cast<std::size_t>(x)] += static_cast<float>(part / kSubRows);
        }
    }

    void blend(int y, const std::vector<float>& coverage, const Color& color, float opacity) {
        Color* row =
            mPixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(mWidth);
        for (std::size_t x = 0; x < coverage.size(); ++x) {
            const float alpha = std::min(coverage[x], 1.0f) * opacity;
            row[x] += (color - row[x]) * alpha;
        }
    }

    int mWidth, mHeight;
    std::vector<Color> mPixels;
};

/// Parts of a line that a dash pattern leaves.
std::vector<Contour> cutDashes(const Contour& points, const std::vector<double>& dash) {
    if (dash.empty()) {
        return {points};
    }
    std::vector<Contour> parts;
    std::size_t index = 0;
    double left = dash[0];
    Contour current{points.front()};
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        glm::dvec2 from = points[i];
        const glm::dvec2 to = points[i + 1];
        double length = glm::distance(from, to);
        while (length > left) {
            from += (to - from) * (left / length);
            length -= left;
            current.push_back(from);
            if (index % 2 == 0) {
                parts.push_back(current);
            }
            current = {from};
            left = std::max(dash[++index % dash.size()], 1e-3);
        }
        left -= length;
        current.push_back(to);
    }
    if (index % 2 == 0) {
        parts.push_back(current);
    }
    return parts;
}

/// A quadrilateral around each piece and a disk at each joint, all winding the same way.
void appendStroke(const Contour& points, double width, std::vector<Contour>& contours) {
    constexpr int kDiskSides = 12;
    const double half = 0.5 * width;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const glm::dvec2 along = points[i + 1] - points[i];
        const double length = glm::length(along);
        if (length <= 0.0) {
            continue;
        }
        const glm::dvec2 side = glm::dvec2(-along.y, along.x) * (half / length);
        contours.push_back(
            {points[i] - side, points[i + 1] - side, points[i + 1] + side, points[i] + side});
        if (i > 0 && width > 1.0) {
            Contour disk;
            for (int corner = 0; corner < kDiskSides; ++corner) {
                const double angle = 2.0 * std::numbers::pi * corner / kDiskSides;
                disk.push_back(points[i] + half * glm::dvec2(std::cos(angle), std::sin(angle)));
            }
            contours.push_back(disk);
        }
    }
}

Contour scaled(const Contour& points, double scale) {
    Contour out = points;
    for (glm::dvec2& point : out) {
        point *= scale;
    }
    return out;
}

void draw(const Stroke& stroke, double scale, Canvas& canvas) {
    if (stroke.points.size() < 2) {
        return;
    }
    std::vector<double> dash = stroke.dash;
    for (double& length : dash) {
        length *= scale;
    }
    std::vector<Contour> contours;
    for (const Contour& part : cutDashes(scaled(stroke.points, scale), dash)) {
        appendStroke(part, stroke.width * scale, contours);
    }
    canvas.fill(contours, stroke.color, stroke.opacity);
}

void draw(const Fill& fill, double scale, Canvas& canvas) {
    canvas.fill({scaled(fill.points, scale)}, fill.color, fill.opacity);
}

void draw(const Text& text, double scale, Canvas& canvas) {
    const double width = textWidth(text.text, text.size);
    const double shift = text.align == Align::Left     ? 0.0
                         : text.align == Align::Center ? -0.5 * width
                                                       : -width;
    std::vector<Contour> contours = textOutlines(text.text, text.size);
    for (Contour& contour : contours) {
        for (glm::dvec2& point : contour) {
            point.x += shift;
            if (text.isVertical) {
                point = {point.y, -point.x};
            }
            point = (point + text.position) * scale;
        }
    }
    canvas.fill(contours, text.color, 1.0);
}

} // namespace

FloatImage rasterize(const Drawing& drawing, double scale) {
    const int width = std::max(1, static_cast<int>(std::lround(drawing.size.x * scale)));
    const int height = std::max(1, static_cast<int>(std::lround(drawing.size.y * scale)));
    Canvas canvas(width, height);
    for (const Shape& shape : drawing.shapes) {
        std::visit([&](const auto& one) { draw(one, scale, canvas); }, shape);
    }
    FloatImage image{width, height, {"R", "G", "B"}, {}};
    image.pixels.reserve(canvas.pixels().size() * 3);
    for (const Color& pixel : canvas.pixels()) {
        image.pixels.insert(image.pixels.end(), {pixel.r, pixel.g, pixel.b});
    }
    return image;
}

} // namespace celadon::plot
