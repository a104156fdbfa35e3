#include "subedit/models/single_scattering.h"

#include "subedit/models/gauss_legendre.h"
#include "subedit/models/half_space.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace celadon::subedit {

// With the cosine mu = t / d of the angle at the surface: d = r / sqrt(1 - mu^2),
// dt = r (1 - mu^2)^(-3/2) dmu, so that dt mu / d^2 = mu (1 - mu^2)^(-1/2) dmu / r, and with
// mu = sin a the integral is that of sin a da / r over angles. Total reflection leaves a range
// [a_c, pi/2], and a = a_c + (pi/2 - a_c) s^2 smooths the square root at its border.
SingleScattering::SingleScattering(double sigmaA, double sigmaSPrime, double eta)
    : mScattering(sigmaSPrime), mExtinction(sigmaA + sigmaSPrime) {
    const double critical = eta > 1.0 ? std::asin(std::sqrt(1.0 - 1.0 / (eta * eta))) : 0.0;
    const double range = 0.5 * std::numbers::pi - critical;
    std::vector<QuadratureNode> quadrature;
    for (int panel = 0; panel < 4; ++panel) {
        appendGaussLegendre(quadrature, panel / 4.0, (panel + 1) / 4.0, 12);
    }
    std::vector<Node> nodes;
    for (const QuadratureNode& node : quadrature) {
        const double s = node.position;
        const double angle = critical + range * s * s;
        const double sine = std::sin(angle);
        const double cosine = std::cos(angle);
        const double transmittance = eta == 1.0 ? 1.0 : 1.0 - fresnelReflectance(sine, 1.0 / eta);
        nodes.push_back(
            {(sine + 1.0) / cosine, node.weight * 2.0 * s * range * sine * transmittance});
    }
    mNodes = std::make_shared<const std::vector<Node>>(std::move(nodes));
}

double SingleScattering::reflectance(double r) const {
    if (r <= 0.0) {
        return std::numeric_limits<double>::infinity();
    }
    double sum = 0.0;
    for (const Node& node : *mNodes) {
        sum += node.weight * std::exp(-mExtinction * r * node.reach);
    }
    return mScattering / (4.0 * std::numbers::pi * r) * sum;
}

} // namespace celadon::subedit
