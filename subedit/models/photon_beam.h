#pragma once

#include "subedit/medium.h"
#include "subedit/radial_curve.h"

/// Photon beam diffusion, Habel, Christensen, Jarosz 2013, "Photon Beam Diffusion: A Hybrid Monte
/// Carlo Method for Subsurface Scattering": sources all along the refracted beam, each a better
/// dipole, and single scattering exactly.
namespace celadon::subedit {

/// Perpendicular incidence. The beam is integrated by quadrature, where the paper draws samples.
/// All orders of scattering; infinite at r = 0.
/// @param medium valid by validateMedium()
[[nodiscard]] RadialCurves photonBeamProfile(const Medium& medium);

} // namespace celadon::subedit
