#pragma once

#include "subedit/radial_curve.h"

#include <cmath>
#include <numbers>

namespace celadon::test {

/// 2 pi integral of P r dr by the midpoint rule over ln r, which suits peaks at 0 and long tails.
inline double integrate(const subedit::RadialCurve& curve, double from, double to,
                        int steps = 20000) {
    const double step = std::log(to / from) / steps;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double r = from * std::exp((i + 0.5) * step);
        sum += curve.reflectance(r) * r * r * step;
    }
    return 2.0 * std::numbers::pi * sum;
}

} // namespace celadon::test
