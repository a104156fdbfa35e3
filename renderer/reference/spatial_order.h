#pragma once

#include "renderer/scene/point_bounds.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// Points along a Morton curve, so that a run of them is near each other.
namespace celadon {

/// Interleaved 16-bit cells of the position within the bounds, x lowest.
[[nodiscard]] std::uint64_t mortonKey(glm::vec3 position, const PointBounds& bounds);

/// The order in which to visit points (anything with positionMm); equal places by index.
template<typename Point>
[[nodiscard]] std::vector<std::uint32_t> spatialOrder(std::span<const Point> points) {
    PointBounds bounds;
    for (const Point& point : points) {
        bounds.add(point.positionMm);
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        keyed[i] = {mortonKey(points[i].positionMm, bounds), i};
    }
    std::ranges::sort(keyed);
    std::vector<std::uint32_t> order(points.size());
    std::ranges::transform(keyed, order.begin(), [](const auto& k) { return k.second; });
    return order;
}

} // namespace celadon
