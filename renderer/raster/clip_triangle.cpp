#include "renderer/raster/clip_triangle.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace celadon {

namespace {

/// Inside where the scalar product with (x, y, z, w) plus an offset is at least 0.
struct Plane {
    glm::dvec4 direction;
    double offset = 0.0;

    [[nodiscard]] double distance(const glm::dvec4& point) const {
        return glm::dot(direction, point) + offset;
    }
};

void clipBy(const Plane& plane, std::vector<glm::dvec4>& polygon) {
    std::vector<glm::dvec4> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec4& here = polygon[i];
        const glm::dvec4& next = polygon[(i + 1) % polygon.size()];
        const double a = plane.distance(here);
        const double b = plane.distance(next);
        if (a >= 0.0) {
            inside.push_back(here);
        }
        if ((a >= 0.0) != (b >= 0.0)) {
            inside.push_back(glm::mix(here, next, a / (a - b)));
        }
    }
    polygon = std::move(inside);
}

/// A hair inside of what toScreen() admits, so that rounding does not put a vertex outside again.
std::vector<Plane> planesOf(const ClipLimits& limits) {
    const double guard = 0.999 * static_cast<double>(kGuardBand);
    std::vector<Plane> planes{{{0.0, 0.0, 0.0, 1.0}, -1.001 * static_cast<double>(limits.leastW)},
                              {{1.0, 0.0, 0.0, guard}},
                              {{-1.0, 0.0, 0.0, guard}},
                              {{0.0, 1.0, 0.0, guard}},
                              {{0.0, -1.0, 0.0, guard}}};
    if (!limits.clampsDepth) {
        planes.push_back({{0.0, 0.0, -1.0, 1.0}});
        planes.push_back({{0.0, 0.0, 1.0, 0.0}});
    }
    return planes;
}

ScreenVertex toScreenInside(const glm::dvec4& clip, const ClipLimits& limits) {
    glm::vec4 point(clip);
    if (!limits.clampsDepth) {
        point.z = glm::clamp(point.z, 0.0f, point.w);
    }
    return toScreen(point, limits);
}

} // namespace

void clipTriangle(const std::array<glm::vec4, 3>& clip, const ClipLimits& limits,
                  std::vector<std::array<ScreenVertex, 3>>& parts) {
    std::vector<glm::dvec4> polygon(clip.begin(), clip.end());
    const bool isFinite = std::ranges::all_of(
        polygon, [](const glm::dvec4& point) { return std::isfinite(glm::dot(point, point)); });
    if (!isFinite) {
        return;
    }
    for (const Plane& plane : planesOf(limits)) {
        clipBy(plane, polygon);
    }
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const std::array<ScreenVertex, 3> part{toScreenInside(polygon[0], limits),
                                               toScreenInside(polygon[i - 1], limits),
                                               toScreenInside(polygon[i], limits)};
        if (std::ranges::none_of(part, &ScreenVertex::isBeyond)) {
            parts.push_back(part);
        }
    }
}

} // namespace celadon
