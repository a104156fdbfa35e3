#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace celadon {

/// The box along the axes that holds some points; without any, turned inside out.
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
    /// Squares of the least and greatest distance of a point.
    [[nodiscard]] glm::vec2 squaredDistances(glm::vec3 p) const {
        const glm::vec3 below = low - p;
        const glm::vec3 above = p - high;
        const glm::vec3 nearest = glm::max(glm::max(below, above), glm::vec3(0.0f));
        const glm::vec3 farthest = glm::max(glm::abs(below), glm::abs(above));
        return {glm::dot(nearest, nearest), glm::dot(farthest, farthest)};
    }
    /// Least and greatest distance of a point.
    [[nodiscard]] glm::vec2 distances(glm::vec3 p) const { return glm::sqrt(squaredDistances(p)); }
};

} // namespace celadon
