#pragma once

#include "subedit/medium.h"
#include "subedit/radial_curve.h"

/// The dipole of d'Eon 2012, "A Better Dipole": Grosjean's diffusion coefficient, exact Fresnel
/// moments, and an exitance that takes both the fluence and the flux at the surface.
namespace celadon::subedit {

/// Equations 1 to 8 of that paper, alpha'^2 as published: light scattered more than once. Finite at
/// r = 0.
/// @param medium valid by validateMedium()
[[nodiscard]] RadialCurves betterDipoleProfile(const Medium& medium);

} // namespace celadon::subedit
