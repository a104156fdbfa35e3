#pragma once

#include "subedit/map/material_map.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>

/// Measured responses R_d(x_i, x_o) factored into SubEdit profiles (Song et al. 2009, section 4):
/// R_d = sqrt(P_xi(r) P_xo(r)), so that ln R_d is linear in the unknown ln P, and a sparse least
/// squares problem gives all profiles at once.
namespace celadon::subedit {

/// One pair of points.
struct ResponseSample {
    glm::vec2 uvIn;     ///< where light enters; texture coordinates, v down
    glm::vec2 uvOut;    ///< where it leaves
    float distanceMm;   ///< >= 0
    glm::vec3 response; ///< R_d in 1/mm^2; a channel that is not above 0 is left out
};

struct ResponseFitSettings {
    int width = 16;
    int height = 16;
    int segments = 24;
    double maxRadiusMm = 0.0;        ///< r_s; 0: the largest distance of the samples
    double radialSmoothness = 0.01;  ///< weight of the second differences of ln P over r
    double spatialSmoothness = 0.01; ///< of the differences between neighboring texels
};

struct ResponseFit {
    MaterialMap map;
    glm::dvec3 rmsLogError{0.0}; ///< of ln R_d, weighted by R_d
    /// Root of the sum of squared errors of R_d over that of its squares.
    glm::dvec3 relativeError{0.0};
    std::size_t used = 0;    ///< samples within r_s with a response
    std::size_t leftOut = 0; ///< others
    int texelsWithout = 0;   ///< that no sample touches: filled from their neighbors
    int clamped = 0;         ///< profiles whose albedo came out above 1: scaled to 1
};

/// Samples weigh by the square root of their response, so that errors near the peak and in the tail
/// both count. Bilinear over the texels; texels and radii that no sample reaches are smooth
/// continuations.
/// @throws InputError if no sample can be used
[[nodiscard]] ResponseFit fitResponses(std::span<const ResponseSample> samples,
                                       const ResponseFitSettings& settings);

} // namespace celadon::subedit
