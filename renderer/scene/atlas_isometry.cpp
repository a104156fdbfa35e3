#include "renderer/scene/atlas_isometry.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace celadon::atlas {
namespace {

Coordinates toMatrix(const Planar& uv) {
    Coordinates matrix(uv.size(), 2);
    for (std::size_t i = 0; i < uv.size(); ++i) {
        matrix.row(i) = uv[i].transpose();
    }
    return matrix;
}

void fromMatrix(const Coordinates& matrix, Planar& uv) {
    for (std::size_t i = 0; i < uv.size(); ++i) {
        uv[i] = matrix.row(i).transpose();
    }
}

Eigen::Matrix2d jacobianAt(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                           std::size_t t, const Coordinates& u) {
    const std::array<int, 3>& c = mesh.corners[t];
    const Eigen::Matrix<double, 2, 3>& g = rest[t].gradients;
    // The gradients sum to zero: two sides will do.
    const Eigen::RowVector2d b = u.row(c[1]) - u.row(c[0]);
    const Eigen::RowVector2d d = u.row(c[2]) - u.row(c[0]);
    Eigen::Matrix2d J;
    J << b.x() * g(0, 1) + d.x() * g(0, 2), b.x() * g(1, 1) + d.x() * g(1, 2),
        b.y() * g(0, 1) + d.y() * g(0, 2), b.y() * g(1, 1) + d.y() * g(1, 2);
    return J;
}

double symmetricEnergy(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                       const Coordinates& u) {
    double energy = 0.0;
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const Eigen::Matrix2d J = jacobianAt(mesh, rest, t, u);
        const double det = J.determinant();
        if (!(det > 0.0)) {
            return std::numeric_limits<double>::infinity();
        }
        energy += rest[t].area * J.squaredNorm() * (1.0 + 1.0 / (det * det));
    }
    return energy;
}

Coordinates symmetricGradient(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                              const Coordinates& u) {
    Coordinates gradient = Coordinates::Zero(u.rows(), 2);
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const Eigen::Matrix2d J = jacobianAt(mesh, rest, t, u);
        const double det = J.determinant();
        Eigen::Matrix2d cofactor; // of J: the derivative of det J
        cofactor << J(1, 1), -J(1, 0), -J(0, 1), J(0, 0);
        const Eigen::Matrix2d slope =
            rest[t].area * (2.0 * (1.0 + 1.0 / (det * det)) * J -
                            2.0 * J.squaredNorm() / (det * det * det) * cofactor);
        const Eigen::Matrix<double, 2, 3> perCorner = slope * rest[t].gradients;
        for (int k = 0; k < 3; ++k) {
            gradient.row(mesh.corners[t][k]) += perCorner.col(k).transpose();
        }
    }
    return gradient;
}

/// The longest step along `d` before the first triangle collapses: the smallest positive root of
/// det(J + s dJ), a quadratic in s per triangle (Smith and Schaefer 2015, section 3.3).
double stepToCollapse(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                      const Coordinates& u, const Coordinates& d) {
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const Eigen::Matrix2d J = jacobianAt(mesh, rest, t, u);
        const Eigen::Matrix2d D = jacobianAt(mesh, rest, t, d);
        const double a = D.determinant();
        const double b =
            J(0, 0) * D(1, 1) + D(0, 0) * J(1, 1) - J(0, 1) * D(1, 0) - D(0, 1) * J(1, 0);
        const double c = J.determinant();
        const double discriminant = b * b - 4.0 * a * c;
        if (discriminant < 0.0) {
            continue;
        }
        // c > 0; of the two roots the numerically stable forms.
        const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
        for (const double root : {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0}) {
            if (root > 0.0) {
                step = std::min(step, root);
            }
        }
    }
    return step;
}

double dot(const Coordinates& a, const Coordinates& b) {
    return a.cwiseProduct(b).sum();
}

struct Correction {
    Coordinates step, change;
    double rho;
};

/// Two-loop recursion (Nocedal 1980) with the inverse Laplacian in the middle.
Coordinates quasiNewton(const std::deque<Correction>& history, const PlanarSolver& solver,
                        Coordinates gradient) {
    std::vector<double> alphas(history.size());
    for (std::size_t i = history.size(); i-- > 0;) {
        alphas[i] = history[i].rho * dot(history[i].step, gradient);
        gradient -= alphas[i] * history[i].change;
    }
    Coordinates direction = 0.25 * solver.solve(gradient);
    for (std::size_t i = 0; i < history.size(); ++i) {
        const double beta = history[i].rho * dot(history[i].change, direction);
        direction += (alphas[i] - beta) * history[i].step;
    }
    return -direction;
}

} // namespace

double relaxRigid(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                  const PlanarSolver& solver, int maxIterations, double tolerance, Planar& uv) {
    constexpr int kWarmUp = 5;
    constexpr double kHopeless = 3.0;
    Coordinates u = toMatrix(uv);
    Coordinates right(u.rows(), 2);
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        right.setZero();
        double energy = 0.0;
        double total = 0.0;
        for (std::size_t t = 0; t < rest.size(); ++t) {
            const Eigen::Matrix2d J = jacobianAt(mesh, rest, t, u);
            const double x = J(0, 0) + J(1, 1);
            const double y = J(1, 0) - J(0, 1);
            const double norm = std::sqrt(x * x + y * y);
            Eigen::Matrix2d R = Eigen::Matrix2d::Identity(); // the nearest rotation
            if (norm > 0.0) {
                R << x / norm, -y / norm, y / norm, x / norm;
            }
            energy += rest[t].area * (J - R).squaredNorm();
            total += rest[t].area;
            const Eigen::Matrix<double, 2, 3> pull = rest[t].area * R * rest[t].gradients;
            for (int k = 0; k < 3; ++k) {
                right.row(mesh.corners[t][k]) += pull.col(k).transpose();
            }
        }
        energy /= total;
        if (iteration >= kWarmUp && energy > kHopeless * tolerance) {
            return energy;
        }
        u = solver.solve(right); // the laplacian holds vertex 0 at the origin
        if (previous - energy < 1e-4 + 0.01 * energy) {
            previous = energy;
            break;
        }
        previous = energy;
    }
    fromMatrix(u, uv);
    return previous;
}

void relaxSymmetric(const ChartMesh& mesh, const std::vector<RestTriangle>& rest,
                    const PlanarSolver& solver, int maxIterations, double leastGain, Planar& uv) {
    constexpr std::size_t kMemory = 6;
    Coordinates u = toMatrix(uv);
    double energy = symmetricEnergy(mesh, rest, u);
    if (!std::isfinite(energy)) {
        return;
    }
    Coordinates gradient = symmetricGradient(mesh, rest, u);
    std::deque<Correction> history;
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        Coordinates direction = quasiNewton(history, solver, gradient);
        double slope = dot(direction, gradient);
        if (!(slope < 0.0)) {
            history.clear();
            direction = quasiNewton(history, solver, gradient);
            slope = dot(direction, gradient);
            if (!(slope < 0.0)) {
                break;
            }
        }
        double step = std::min(1.0, 0.8 * stepToCollapse(mesh, rest, u, direction));
        Coordinates moved;
        double lower = std::numeric_limits<double>::infinity();
        for (int halving = 0; halving < 20; ++halving, step *= 0.5) {
            moved = u + step * direction;
            lower = symmetricEnergy(mesh, rest, moved);
            if (lower <= energy + 1e-4 * step * slope) {
                break;
            }
        }
        if (!(lower < energy)) {
            break;
        }
        const bool converged = energy - lower < leastGain * lower;
        Coordinates newGradient = symmetricGradient(mesh, rest, moved);
        Correction correction{moved - u, newGradient - gradient, 0.0};
        const double curvature = dot(correction.step, correction.change);
        if (curvature > 0.0) {
            correction.rho = 1.0 / curvature;
            history.push_back(std::move(correction));
            if (history.size() > kMemory) {
                history.pop_front();
            }
        }
        u = std::move(moved);
        gradient = std::move(newGradient);
        energy = lower;
        if (converged) {
            break;
        }
    }
    fromMatrix(u, uv);
}

bool isOriented(const ChartMesh& mesh, const std::vector<RestTriangle>& rest, const Planar& uv) {
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const std::array<int, 3>& c = mesh.corners[t];
        if (!(rest[t].jacobian(uv[c[0]], uv[c[1]], uv[c[2]]).determinant() > 1e-6)) {
            return false;
        }
    }
    return true;
}

} // namespace celadon::atlas
