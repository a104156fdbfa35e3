#include "subedit/radial_curve.h"

namespace celadon::subedit {

double radiusHolding(const RadialCurve& curve, double fraction) {
    if (curve.total <= 0.0) {
        return 0.0;
    }
    const double energy = fraction * curve.total;
    double high = 1.0;
    while (curve.energyWithin(high) > energy && high > 1e-9) {
        high *= 0.5;
    }
    while (curve.energyWithin(high) < energy && high < 1e9) {
        high *= 2.0;
    }
    double low = 0.0;
    while (high - low > 1e-12 * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) {
            break;
        }
        (curve.energyWithin(middle) < energy ? low : high) = middle;
    }
    return high;
}

} // namespace celadon::subedit
