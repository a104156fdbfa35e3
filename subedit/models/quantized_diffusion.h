#pragma once

#include "subedit/medium.h"
#include "subedit/radial_curve.h"

/// Quantized diffusion, d'Eon and Irving 2011, "A Quantized-Diffusion Model for Rendering
/// Translucent Materials": sources all along the refracted beam, by a sum of Gaussians whose
/// weights are in closed form; with single scattering added, exactly.
namespace celadon::subedit {

/// Perpendicular incidence. All orders of scattering; infinite at r = 0 (by its single scattering).
/// @param medium valid by validateMedium()
[[nodiscard]] RadialCurves quantizedDiffusionProfile(const Medium& medium);

/// e^(x^2) erfc(x), which neither factor could hold for large x.
[[nodiscard]] double scaledErfc(double x);

} // namespace celadon::subedit
