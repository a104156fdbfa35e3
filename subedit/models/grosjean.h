#pragma once

#include <vector>

/// What the diffusion models after d'Eon and Irving 2011 share: Grosjean's diffusion with its
/// boundary condition and exitance (d'Eon, Irving 2011, "A Quantized-Diffusion Model for Rendering
/// Translucent Materials", sections 3 and 4; d'Eon 2012, "A Better Dipole").
namespace celadon::subedit {

struct GrosjeanMedium {
    double alphaPrime;       ///< reduced albedo
    double extinction;       ///< sigma_t', 1/mm
    double diffusion;        ///< D = (2 sigma_a + sigma_s') / (3 sigma_t'^2), mm (Grosjean 1956)
    double sigmaTr;          ///< sqrt(sigma_a / D), 1/mm
    double extrapolationMm;  ///< z_b = 2 A D, A = (1 + 3 C_2) / (1 - 2 C_1)
    double fluenceFactor;    ///< C_phi = (1 - 2 C_1) / 4: exitance per fluence at the surface
    double irradianceFactor; ///< C_E = (1 - 3 C_2) / 2: exitance per vector irradiance

    GrosjeanMedium(double sigmaA, double sigmaSPrime, double eta);
};

/// C_n = integral of F_r(mu) mu^n dmu over [0, 1], F_r the Fresnel reflectance met from within; by
/// quadrature split at the critical angle (the papers print polynomial fits).
/// @param eta relative index of refraction of the medium
[[nodiscard]] double internalFresnelMoment(double eta, int n);

} // namespace celadon::subedit
