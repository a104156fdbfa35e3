#pragma once

#include <array>
#include <functional>

/// A scattering profile as a model or a measurement gives it, before it is fitted to segments.
namespace celadon::subedit {

/// One channel. `energyWithin` keeps exact what quadrature of a peaked P(r) would lose.
struct RadialCurve {
    std::function<double(double)>
        reflectance; ///< P(r) in 1/mm^2, r in mm >= 0; may be infinite at 0
    std::function<double(double)> energyWithin; ///< 2 pi integral of P r dr over [0, r]
    double total = 0.0;                         ///< diffuse albedo: energyWithin(infinity)
};

using RadialCurves = std::array<RadialCurve, 3>; ///< red, green, blue

/// Radius in mm within which the curve has `fraction` of its total; 0 for a black curve.
[[nodiscard]] double radiusHolding(const RadialCurve& curve, double fraction);

} // namespace celadon::subedit
