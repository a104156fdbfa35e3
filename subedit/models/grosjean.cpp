#include "subedit/models/grosjean.h"

#include "subedit/models/gauss_legendre.h"
#include "subedit/models/half_space.h"

#include <cmath>
#include <vector>

namespace celadon::subedit {

double internalFresnelMoment(double eta, int n) {
    if (eta == 1.0) {
        return 0.0;
    }
    const double critical = eta > 1.0 ? std::sqrt(1.0 - 1.0 / (eta * eta)) : 0.0;
    // Below the critical cosine all light is reflected. Above it F_r leaves 1 like a square root,
    // which mu = critical + (1 - critical) s^2 makes smooth.
    std::vector<QuadratureNode> nodes;
    appendGaussLegendre(nodes, 0.0, 1.0, 48);
    double moment = std::pow(critical, n + 1) / (n + 1);
    for (const QuadratureNode& node : nodes) {
        const double mu = critical + (1.0 - critical) * node.position * node.position;
        moment += node.weight * 2.0 * node.position * (1.0 - critical) *
                  fresnelReflectance(mu, 1.0 / eta) * std::pow(mu, n);
    }
    return moment;
}

GrosjeanMedium::GrosjeanMedium(double sigmaA, double sigmaSPrime, double eta) {
    extinction = sigmaA + sigmaSPrime;
    alphaPrime = sigmaSPrime / extinction;
    diffusion = (2.0 * sigmaA + sigmaSPrime) / (3.0 * extinction * extinction);
    sigmaTr = std::sqrt(sigmaA / diffusion);
    const double first = internalFresnelMoment(eta, 1);
    const double second = internalFresnelMoment(eta, 2);
    extrapolationMm = 2.0 * diffusion * (1.0 + 3.0 * second) / (1.0 - 2.0 * first);
    fluenceFactor = 0.25 * (1.0 - 2.0 * first);
    irradianceFactor = 0.5 * (1.0 - 3.0 * second);
}

} // namespace celadon::subedit
