#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>

/// The two ends of light transport below a surface: lit patches, where flux enters, and exit
/// points, where the exitance is wanted (DESIGN sections 1 and 3.1).
namespace celadon {

/// A small piece of lit surface: its flux, and how its positions spread about their mean.
struct Patch {
    glm::vec3 positionMm{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    glm::vec3 flux{0.0f};              ///< transmitted flux E dA, W per channel
    std::array<float, 6> covariance{}; ///< of the positions, mm^2: xx xy xz yy yz zz; 0: a point
    glm::vec2 uv{0.0f};
    int material = 0; ///< index into the materials, >= 0
};

/// The corners of a patch that is a triangle, for exit points near it. mm.
using PatchTriangle = std::array<glm::vec3, 3>;

/// Where the exitance is wanted.
struct ExitPoint {
    glm::vec3 positionMm{0.0f};
    glm::vec2 uv{0.0f};
    int material = -1; ///< index into the materials; < 0: background, exitance 0
};

/// The flux of all of them together, W.
[[nodiscard]] glm::dvec3 totalFlux(std::span<const Patch> patches);

/// A patch that spreads evenly in all directions of its tangent plane: covariance half of
/// variance (I - n n^T).
/// @param flux         W per channel, transmitted
/// @param varianceMm2  mean square distance of its positions from their mean
[[nodiscard]] Patch makePatch(glm::vec3 positionMm, glm::vec3 normal, glm::vec3 flux,
                              float varianceMm2, glm::vec2 uv, int material);

/// The patch that a texel of a light view sees. Its variance is a / 6 / max(0.1, cosine)^2: that of
/// a square as wide as the texel is long up the slope, so that it reaches its neighbors there
/// (shaders/irradiance_buffer.frag).
/// @param crossSectionMm2  a, the texel's area on a plane that faces the light
/// @param cosine           of the angle between the surface's normal and the light
[[nodiscard]] Patch makeTexelPatch(glm::vec3 positionMm, glm::vec3 normal, glm::vec3 flux,
                                   float crossSectionMm2, float cosine, glm::vec2 uv, int material);

} // namespace celadon
