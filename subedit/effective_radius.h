#pragma once

#include <glm/vec3.hpp>

/// Energy and radii of one stored profile, in closed form per log-linear segment.
namespace celadon::subedit {

/// One texel's profile: ln P at segments + 1 knots, three channels, channel fastest.
struct ProfileView {
    const float* logProfile;
    int segments;
    float maxRadiusMm;
};

/// Diffuse albedo A = 2 pi integral of P r dr over [0, r_s], per channel.
[[nodiscard]] glm::dvec3 diffuseAlbedo(const ProfileView& profile);

/// Integral of P r dr over [0, radiusMm], per channel, 1 (no 2 pi).
[[nodiscard]] glm::dvec3 radialEnergy(const ProfileView& profile, double radiusMm);

/// Effective scattering radius R_P per channel: the radius in mm that holds `energyFraction` of the
/// profile's integral of P r dr. DESIGN section 1: R_P of a texel is the largest of the three.
[[nodiscard]] glm::dvec3 effectiveRadiusMm(const ProfileView& profile,
                                           double energyFraction = 0.95);

} // namespace celadon::subedit
