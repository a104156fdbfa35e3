#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

/// Points along a Morton curve, so that a run of them is near each other.
namespace celadon {

struct PointBounds {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};

    void add(glm::vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    [[nodiscard]] float squaredDistance(const PointBounds& other) const {
        const glm::vec3 gap =
            glm::max(glm::max(low - other.high, other.low - high), glm::vec3(0.0f));
        return gap.x * gap.x + gap.y * gap.y + gap.z * gap.z;
    }
};

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
