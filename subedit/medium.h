#pragma once

#include <glm/vec3.hpp>

#include <string>

/// Optical coefficients of a homogeneous scattering medium, per RGB channel.
namespace celadon::subedit {

struct Medium {
    glm::dvec3 absorption{0.0};        ///< sigma_a, 1/mm, >= 0
    glm::dvec3 reducedScattering{1.0}; ///< sigma_s' = sigma_s (1 - g), 1/mm, > 0
    double eta = 1.3;                  ///< relative index of refraction, > 0
    /// Mean cosine of scattering (Henyey, Greenstein 1941), in (-1, 1). Diffusion models know only
    /// sigma_s'; the random walk scatters by sigma_s = sigma_s' / (1 - g).
    double anisotropy = 0.0;

    /// sigma_t' = sigma_a + sigma_s', 1/mm
    [[nodiscard]] glm::dvec3 reducedExtinction() const { return absorption + reducedScattering; }
    /// alpha' = sigma_s' / sigma_t'
    [[nodiscard]] glm::dvec3 reducedAlbedo() const {
        return reducedScattering / reducedExtinction();
    }
};

/// @param reducedAlbedo  alpha' of single scattering, each in (0, 1]
/// @param meanFreePathMm 1 / sigma_t', each > 0
[[nodiscard]] Medium mediumFromAlbedo(const glm::dvec3& reducedAlbedo,
                                      const glm::dvec3& meanFreePathMm, double eta);

/// @throws UsageError naming the coefficient, the channel and the reason
void validateMedium(const Medium& medium);

/// Names "red", "green", "blue" for messages.
[[nodiscard]] const char* channelName(int channel);

} // namespace celadon::subedit
