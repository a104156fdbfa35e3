#include "subedit/models/gauss_legendre.h"

#include <cmath>
#include <numbers>

namespace celadon::subedit {

void appendGaussLegendre(std::vector<QuadratureNode>& nodes, double from, double to, int count) {
    for (int i = 0; i < count; ++i) {
        // Newton on the Legendre recurrence, from the usual estimate of the root.
        double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
        double derivative = 1.0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double previous = 1.0;
            double value = x;
            for (int n = 2; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
                previous = value;
                value = next;
            }
            derivative = count * (x * value - previous) / (x * x - 1.0);
            const double step = value / derivative;
            x -= step;
            if (std::abs(step) < 1e-15) {
                break;
            }
        }
        const double weight = 2.0 / ((1.0 - x * x) * derivative * derivative);
        nodes.push_back({from + (to - from) * 0.5 * (1.0 + x), weight * 0.5 * (to - from)});
    }
}

} // namespace celadon::subedit
