#pragma once

/// Exact unpolarized Fresnel terms of a smooth dielectric boundary (DESIGN section 1): what of the
/// light enters the material, and the constant that makes what leaves it the radiant exitance.
/// `eta` is always the index beyond the boundary over the index on the side of the ray.
namespace celadon {

enum class ExitFresnel {
    Exact, ///< c = 2 integral of F_t cos sin: what leaves is B (DESIGN 1)
    Paper  ///< c = 1 (Chen et al. 2012, eq. 7)
};

/// Reflectance F_r of unpolarized light.
/// @param cosTheta cosine between ray and normal, clamped to [0, 1]
/// @param eta      relative index of refraction, > 0; below 1 the ray is inside the denser medium
/// @return         in [0, 1]; 1 at grazing incidence (unless eta is 1) and in total internal
///                 reflection
[[nodiscard]] double fresnelReflectance(double cosTheta, double eta);

/// Transmittance F_t = 1 - F_r. The same from both sides along one refracted path.
[[nodiscard]] double fresnelTransmittance(double cosTheta, double eta);

/// c = 2 integral of F_t(theta) cos theta sin theta dtheta over [0, pi/2]: the hemispherical
/// transmittance of diffuse light. L = F_t / (pi c) B then has radiant exitance B.
/// @return in (0, 1], to 1e-12 or better
[[nodiscard]] double diffuseTransmittance(double eta);

} // namespace celadon
