#pragma once

#include <vector>

/// Gauss-Legendre quadrature: exact for polynomials of degree 2 n - 1, and the right tool for the
/// smooth integrands of scattering models once their kinks lie on borders.
namespace celadon::subedit {

struct QuadratureNode {
    double position;
    double weight;
};

/// Appends `count` nodes for the integral over [from, to].
void appendGaussLegendre(std::vector<QuadratureNode>& nodes, double from, double to, int count);

} // namespace celadon::subedit
