#include "subedit/models/half_space.h"

#include "subedit/models/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace celadon::subedit {

namespace {

using Node = QuadratureNode; ///< position: the cosine mu
constexpr int kNodes = 32;

double inverseH(double mu, double albedo, const std::vector<Node>& nodes,
                const std::vector<double>& h) {
    double sum = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
        sum += nodes[j].weight * nodes[j].position * h[j] / (mu + nodes[j].position);
    }
    return std::sqrt(1.0 - albedo) + 0.5 * albedo * sum;
}

/// H at the nodes, by iterating 1/H = sqrt(1 - w) + w/2 integral of mu' H(mu') / (mu + mu'), the
/// form that converges for albedo 1 as well.
std::vector<double> solveH(double albedo, const std::vector<Node>& nodes) {
    std::vector<double> h(nodes.size(), 1.0);
    for (int iteration = 0; iteration < 500; ++iteration) {
        double change = 0.0;
        std::vector<double> next(h.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            // The mean of old and new damps the alternation around the solution.
            next[i] = 0.5 * (h[i] + 1.0 / inverseH(nodes[i].position, albedo, nodes, h));
            change = std::max(change, std::abs(next[i] - h[i]));
        }
        h = std::move(next);
        if (change < 1e-13) {
            break;
        }
    }
    return h;
}

} // namespace

double fresnelReflectance(double cosine, double eta) {
    const double sineSquared = (1.0 - cosine * cosine) / (eta * eta);
    if (sineSquared >= 1.0) {
        return 1.0;
    }
    const double inner = std::sqrt(1.0 - sineSquared);
    const double parallel = (eta * cosine - inner) / (eta * cosine + inner);
    const double perpendicular = (cosine - eta * inner) / (cosine + eta * inner);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double chandrasekharH(double mu, double albedo) {
    std::vector<Node> nodes;
    appendGaussLegendre(nodes, 0.0, 1.0, kNodes);
    return 1.0 / inverseH(mu, albedo, nodes, solveH(albedo, nodes));
}

double halfSpaceTotal(double reducedAlbedo, double eta) {
    if (reducedAlbedo <= 0.0) {
        return 0.0;
    }
    // Nodes on either side of the critical angle, where the internal reflectance has a kink.
    std::vector<Node> nodes;
    const double critical = eta > 1.0 ? std::sqrt(1.0 - 1.0 / (eta * eta)) : 0.0;
    if (critical > 0.0) {
        appendGaussLegendre(nodes, 0.0, critical, kNodes);
    }
    appendGaussLegendre(nodes, critical, 1.0, kNodes);
    const std::vector<double> h = solveH(reducedAlbedo, nodes);
    const double hNormal = 1.0 / inverseH(1.0, reducedAlbedo, nodes, h);

    // u(mu): flux that reaches the surface from within per cosine; rho u of it goes down again.
    // u(mu) = K(mu, 1) + integral of K(mu, mu') rho(mu') u(mu'),
    // K(mu, mu') = w/2 H(mu) H(mu') mu / (mu + mu')   (Chandrasekhar 1960, ch. V, eq. 2 in flux).
    const std::size_t count = nodes.size();
    std::vector<double> rho(count);
    std::vector<double> source(count);
    for (std::size_t i = 0; i < count; ++i) {
        rho[i] = eta == 1.0 ? 0.0 : fresnelReflectance(nodes[i].position, 1.0 / eta);
        source[i] =
            0.5 * reducedAlbedo * h[i] * hNormal * nodes[i].position / (nodes[i].position + 1.0);
    }
    std::vector<double> u = source;
    for (int iteration = 0; iteration < 2000; ++iteration) {
        double change = 0.0;
        std::vector<double> next = source;
        for (std::size_t i = 0; i < count; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < count; ++j) {
                sum += nodes[j].weight * h[j] * rho[j] * u[j] /
                       (nodes[i].position + nodes[j].position);
            }
            next[i] += 0.5 * reducedAlbedo * h[i] * nodes[i].position * sum;
            change = std::max(change, std::abs(next[i] - u[i]));
        }
        u = std::move(next);
        if (change < 1e-12) {
            break;
        }
    }
    double total = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        total += nodes[i].weight * (1.0 - rho[i]) * u[i];
    }
    return total;
}

double reducedAlbedoFromTotal(double total, double eta) {
    // The total rises with the albedo, from 0 to 1 (eta fixed); close to 1 it does so by the square
    // root of 1 - albedo, which is therefore what is bisected.
    double low = 0.0;
    double high = 1.0;
    while (high - low > 1e-10) {
        const double middle = 0.5 * (low + high);
        (halfSpaceTotal(1.0 - middle * middle, eta) > total ? low : high) = middle;
    }
    const double root = 0.5 * (low + high);
    return 1.0 - root * root;
}

glm::dvec3 halfSpaceTotal(const Medium& medium) {
    const glm::dvec3 albedo = medium.reducedAlbedo();
    return {halfSpaceTotal(albedo.x, medium.eta), halfSpaceTotal(albedo.y, medium.eta),
            halfSpaceTotal(albedo.z, medium.eta)};
}

} // namespace celadon::subedit
