#include "renderer/shading/fresnel.h"

#include "subedit/assert.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon {

double fresnelReflectance(double cosTheta, double eta) {
    CELADON_ASSERT(eta > 0.0);
    const double cosI = std::clamp(cosTheta, 0.0, 1.0);
    if (eta == 1.0) {
        return 0.0;
    }
    // Snell: sin^2 of the refracted angle is sin^2 / eta^2; written as eta^2 cos^2 theta_t, so that
    // its sign is that of total internal reflection with no division before it.
    const double squared = eta * eta - (1.0 - cosI * cosI);
    if (squared <= 0.0) {
        return 1.0;
    }
    const double etaCosT = std::sqrt(squared);
    const double perpendicular = (cosI - etaCosT) / (cosI + etaCosT);
    const double parallel = (eta * eta * cosI - etaCosT) / (eta * eta * cosI + etaCosT);
    return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

double fresnelTransmittance(double cosTheta, double eta) {
    return 1.0 - fresnelReflectance(cosTheta, eta);
}

double diffuseTransmittance(double eta) {
    CELADON_ASSERT(eta > 0.0);
    // With s = sin theta, c = integral of F_t d(s^2). For eta < 1 nothing passes beyond s = eta.
    // F_t starts like a square root of the distance to that end (and of 1 - s^2 for eta > 1), which
    // s^2 = s_max^2 sin^2(phi) makes smooth; composite five-point Gauss-Legendre does the rest.
    // A ratio near 1 keeps a boundary layer of width |eta - 1|^(1/2) at phi = pi/2: the panels
    // shrink towards it geometrically.
    constexpr double kNodes[5] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                  0.9061798459386640};
    constexpr double kWeights[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};
    constexpr int kOctaves = 24;
    constexpr int kPanelsPerOctave = 8;
    const double sMax = std::min(1.0, eta);
    double sum = 0.0;
    double far = 0.5 * std::numbers::pi; // distance from phi = pi/2, outer end of the octave
    for (int octave = 0; octave <= kOctaves; ++octave) {
        const double near = octave == kOctaves ? 0.0 : 0.5 * far;
        const double half = 0.5 * (far - near) / kPanelsPerOctave;
        for (int panel = 0; panel < kPanelsPerOctave; ++panel) {
            const double middle = near + (2 * panel + 1) * half;
            for (int i = 0; i < 5; ++i) {
                const double fromEnd = middle + kNodes[i] * half;
                const double s = sMax * std::cos(fromEnd);
                const double cosTheta = std::sqrt((1.0 - s) * (1.0 + s));
                sum += kWeights[i] * half * fresnelTransmittance(cosTheta, eta) * 2.0 * s * sMax *
                       std::sin(fromEnd);
            }
        }
        far = near;
    }
    return sum;
}

} // namespace celadon
