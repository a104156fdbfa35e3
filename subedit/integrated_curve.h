#pragma once

#include "subedit/radial_curve.h"

/// From P(r) alone to a RadialCurve, with the energies by quadrature.
namespace celadon::subedit {

/// Panels of Gauss-Legendre nodes on a logarithmic grid, from 1e-6 to 1e6 lengths; at both ends P
/// is taken as a power of r with the slope that it has there. Relative error below 1e-5 for P that
/// are smooth in ln r, peaks like 1/r included.
/// @param lengthMm what the curve varies over, such as a mean free path
[[nodiscard]] RadialCurve integrateCurve(std::function<double(double)> reflectance,
                                         double lengthMm);

} // namespace celadon::subedit
