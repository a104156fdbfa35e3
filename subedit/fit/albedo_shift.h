#pragma once

#include "subedit/log_linear.h"

#include <cmath>
#include <numbers>

namespace celadon::subedit {

/// What to add to ln P at every knot so that a profile has this albedo, > 0: a shift keeps its
/// shape.
/// @param logP `segments` + 1 knots of one channel, `stride` values apart
template<typename Number>
[[nodiscard]] double albedoShift(const Number* logP, int stride, int segments, double maxRadiusMm,
                                 double albedo) {
    const double h = maxRadiusMm / segments;
    double energy = 0.0;
    for (int k = 0; k < segments; ++k) {
        energy += pieceEnergy(static_cast<double>(logP[k * stride]),
                              static_cast<double>(logP[(k + 1) * stride]), k * h, h);
    }
    return std::log(albedo / (2.0 * std::numbers::pi * energy));
}

} // namespace celadon::subedit
