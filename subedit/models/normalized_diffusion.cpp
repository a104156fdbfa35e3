#include "subedit/models/normalized_diffusion.h"

#include "subedit/models/half_space.h"
#include "subedit/models/photon_beam.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace celadon::subedit {

double normalizedDiffusionScale(double albedo, DiffusionFit fit) {
    const double fromPeak = std::abs(albedo - 0.8);
    switch (fit) {
    case DiffusionFit::Searchlight:
        return 1.85 - albedo + 7.0 * fromPeak * fromPeak * fromPeak; // eq. 6
    case DiffusionFit::Diffuse:
        return 1.9 - albedo + 3.5 * fromPeak * fromPeak; // eq. 7
    case DiffusionFit::Dmfp:
        return 3.5 + 100.0 * std::pow(albedo - 0.33, 4); // eq. 8
    }
    return 1.0;
}

RadialCurve normalizedDiffusionCurve(double albedo, double d) {
    return {[albedo, d](double r) {
                if (r <= 0.0) {
                    return albedo > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
                }
                return albedo * (std::exp(-r / d) + std::exp(-r / (3.0 * d))) /
                       (8.0 * std::numbers::pi * d * r);
            },
            // expm1 keeps the digits of the difference from 1 at small radii.
            [albedo, d](double r) {
                return -albedo * (0.25 * std::expm1(-r / d) + 0.75 * std::expm1(-r / (3.0 * d)));
            },
            albedo};
}

RadialCurves normalizedDiffusionProfile(const glm::dvec3& albedo, const glm::dvec3& lengthMm,
                                        DiffusionFit fit) {
    RadialCurves curves;
    for (int channel = 0; channel < 3; ++channel) {
        const double scale = normalizedDiffusionScale(albedo[channel], fit);
        curves[static_cast<std::size_t>(channel)] =
            normalizedDiffusionCurve(albedo[channel], lengthMm[channel] / scale);
    }
    return curves;
}

RadialCurves normalizedDiffusionProfile(const Medium& medium) {
    const double unitRadius = normalizedDiffusionRadius();
    const glm::dvec3 albedo = halfSpaceTotal(medium);
    RadialCurves curves = photonBeamProfile(medium);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        curves[channel] = normalizedDiffusionCurve(
            albedo[static_cast<int>(channel)], radiusHolding(curves[channel], 0.95) / unitRadius);
    }
    return curves;
}

double normalizedDiffusionRadius(double energyFraction) {
    return radiusHolding(normalizedDiffusionCurve(1.0, 1.0), energyFraction);
}

} // namespace celadon::subedit
