#pragma once

#include <cmath>

/// Closed forms over one piece of a profile on which ln P is linear (DESIGN section 2).
///
/// With ln P(r_0 + x) = l_0 + b x on a piece of width h, z = b h and x = t h:
///     integral of P r dr over [r_0, r_0 + t h] = P_0 t h (r_0 M_0(t z) + t h M_1(t z)),
/// where M_0(z) and M_1(z) are the integrals of e^(zs) and s e^(zs) over s in [0, 1].
namespace celadon::subedit {

/// M_0(z) = (e^z - 1) / z
[[nodiscard]] inline double expMoment0(double z) {
    return std::abs(z) < 1e-5 ? 1.0 + z * (0.5 + z / 6.0) : std::expm1(z) / z;
}

/// M_1(z) = (e^z - M_0(z)) / z, by its power series where that difference would cancel.
[[nodiscard]] inline double expMoment1(double z) {
    if (std::abs(z) > 0.25) {
        return (std::exp(z) - expMoment0(z)) / z;
    }
    double sum = 0.0;
    double term = 1.0; // z^k / k!
    for (int k = 0; k < 11; ++k) {
        sum += term / (k + 2);
        term *= z / (k + 1);
    }
    return sum;
}

/// Integral of P r dr over the first `t` (0..1) of a piece.
/// @param logStart, logEnd ln P at the two ends of the whole piece
/// @param start            radius where the piece begins
/// @param width            of the whole piece
[[nodiscard]] inline double pieceEnergy(double logStart, double logEnd, double start, double width,
                                        double t = 1.0) {
    const double z = (logEnd - logStart) * t;
    const double x = width * t;
    return std::exp(logStart) * x * (start * expMoment0(z) + x * expMoment1(z));
}

} // namespace celadon::subedit
