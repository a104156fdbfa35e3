#pragma once

#include "subedit/medium.h"
#include "subedit/radial_curve.h"

#include <glm/vec3.hpp>

/// Normalized diffusion, Christensen and Burley 2015, "Approximate Reflectance Profiles for
/// Efficient Subsurface Scattering": two exponentials over r that integrate to the surface albedo
/// by construction, and a scale fitted to Monte Carlo. Infinite at r = 0.
namespace celadon::subedit {

/// Which Monte Carlo experiment the published scale s(A) was fitted to.
enum class DiffusionFit {
    Searchlight, ///< perpendicular pencil, length = mean free path 1 / sigma_t'
    Diffuse,     ///< ideal diffuse transmission, length = mean free path 1 / sigma_t'
    Dmfp         ///< length = diffuse mean free path 1 / sigma_tr
};

/// s(A) of the chosen fit. @param albedo surface albedo, in [0, 1]
[[nodiscard]] double normalizedDiffusionScale(double albedo, DiffusionFit fit);

/// P(r) = A (e^(-r/d) + e^(-r/3d)) / (8 pi d r), d = length / s(A).
/// @param albedo   surface albedo A, each in [0, 1]
/// @param lengthMm mean free path (or diffuse mean free path), each > 0
[[nodiscard]] RadialCurves normalizedDiffusionProfile(const glm::dvec3& albedo,
                                                      const glm::dvec3& lengthMm,
                                                      DiffusionFit fit = DiffusionFit::Searchlight);

/// The curve of a medium given by its coefficients: A is what the half space returns exactly
/// (half_space.h), and d is such that R_P is that of photon beam diffusion, which has it to 5 %.
/// The published s(A) know index-matched media only, and fall short of the range from A = 0.75 on:
/// by random walks R_P is 0.75 of what it should be at alpha' = 0.995, 0.6 at alpha' = 0.95 and eta
/// = 1.4.
[[nodiscard]] RadialCurves normalizedDiffusionProfile(const Medium& medium);

/// One channel by its shape parameter d in mm directly.
[[nodiscard]] RadialCurve normalizedDiffusionCurve(double albedo, double shapeMm);

/// R_P / d: every normalized diffusion profile is the same curve in units of d.
[[nodiscard]] double normalizedDiffusionRadius(double energyFraction = 0.95);

} // namespace celadon::subedit
