#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// What a stroke is made of: a brush and the points that it passed.
namespace celadon::subedit {

struct Brush {
    float radiusMm = 5.0f; ///< of the ball that a dab fills, > 0
    float hardness = 0.5f; ///< part of the radius at full strength, in [0, 1]
    float flow = 1.0f;     ///< what one dab adds, in (0, 1]
    float opacity = 1.0f;  ///< what a stroke reaches at most, in (0, 1]
    float spacing = 0.25f; ///< of dabs along the path, in radii, in [0.02, 4]
    bool operator==(const Brush&) const = default;
};

/// One point of a path: in space, or on the map (`uv`), which then gives position and normal.
struct StrokePoint {
    glm::vec3 positionMm{0.0f};
    glm::vec3 normal{0.0f};           ///< unit length; zero takes that of the nearest texel
    std::optional<glm::vec2> uv = {}; ///< v down, in [0, 1]
    float pressure = 1.0f;            ///< scales the flow, in [0, 1]
    bool isLifted = false; ///< the hand came through the air: nothing is painted on the way to it
    bool operator==(const StrokePoint&) const = default;
};

/// Repeats every dab on the other side of planes through a point.
struct Mirror {
    std::array<bool, 3> axes{false, false, false}; ///< x, y, z
    glm::vec3 centerMm{0.0f};
    bool operator==(const Mirror&) const = default;
};

/// Signs of the coordinates about the center: (1, 1, 1) first, then each side that is mirrored.
[[nodiscard]] inline std::vector<glm::vec3> mirroredSides(const Mirror& mirror) {
    std::vector<glm::vec3> sides{glm::vec3(1.0f)};
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t count = mirror.axes[static_cast<std::size_t>(axis)] ? sides.size() : 0;
        for (std::size_t i = 0; i < count; ++i) {
            glm::vec3 other = sides[i];
            other[axis] = -1.0f;
            sides.push_back(other);
        }
    }
    return sides;
}

/// A place on such a side.
[[nodiscard]] inline glm::vec3 mirrored(const Mirror& mirror, const glm::vec3& signs,
                                        glm::vec3 positionMm) {
    for (int axis = 0; axis < 3; ++axis) {
        positionMm[axis] =
            signs[axis] < 0.0f ? 2.0f * mirror.centerMm[axis] - positionMm[axis] : positionMm[axis];
    }
    return positionMm;
}

} // namespace celadon::subedit
