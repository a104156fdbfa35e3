#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstdint>

/// Vertices on the screen, snapped to a grid on which edge functions are exact in integers, so that
/// triangles that share an edge neither overlap nor leave gaps.
namespace celadon {

constexpr std::int32_t kSubpixels = 256; ///< of a pixel's side
/// Triangles whose coordinates, over w, go beyond are clipped first.
constexpr float kGuardBand = 32.0f;

struct ScreenVertex {
    std::int32_t x = 0, y = 0; ///< pixels times kSubpixels, from the lower left corner
    float z = 0.0f;            ///< depth over w: greater is nearer
    bool isBeyond = false;     ///< the rest means nothing: the triangle must be clipped
};

/// What keeps vertices where they can be divided by w and snapped.
struct ClipLimits {
    glm::vec2 halfSize{0.0f}; ///< of the viewport in subpixels
    float leastW = 0.0f;
    bool clampsDepth = false; ///< nothing is clipped at the near and far planes
};

inline ScreenVertex toScreen(glm::vec4 clip, const ClipLimits& limits) {
    const float guard = kGuardBand * clip.w;
    const bool isInside = clip.w >= limits.leastW && std::abs(clip.x) <= guard &&
                          std::abs(clip.y) <= guard &&
                          (limits.clampsDepth || (clip.z <= clip.w && clip.z >= 0.0f)) &&
                          std::abs(clip.z) < INFINITY && clip.w < INFINITY;
    if (!isInside) {
        return {.isBeyond = true};
    }
    const float scale = 1.0f / clip.w;
    return {static_cast<std::int32_t>(std::lrint((clip.x * scale + 1.0f) * limits.halfSize.x)),
            static_cast<std::int32_t>(std::lrint((clip.y * scale + 1.0f) * limits.halfSize.y)),
            clip.z * scale, false};
}

} // namespace celadon
