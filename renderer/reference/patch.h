#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

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

/// Where the exitance is wanted.
struct ExitPoint {
    glm::vec3 positionMm{0.0f};
    glm::vec2 uv{0.0f};
    int material = -1; ///< index into the materials; < 0: background, exitance 0
};

/// The patch that a texel of a light view sees. Covariance: half of s2 (I - n n^T) with
/// s2 = a / 12 (1 + 1 / max(0.1, cosine)^2), the mean spread of a square that is stretched along
/// the slope by 1 / cosine, made isotropic on the tangent plane.
/// @param flux             W per channel, transmitted
/// @param crossSectionMm2  a, the texel's area on a plane that faces the light
/// @param cosine           of the angle between the surface's normal and the light
[[nodiscard]] Patch makeTexelPatch(glm::vec3 positionMm, glm::vec3 normal, glm::vec3 flux,
                                   float crossSectionMm2, float cosine, glm::vec2 uv, int material);

} // namespace celadon
