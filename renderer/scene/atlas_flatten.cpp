#include "renderer/scene/atlas_flatten.h"

#include "renderer/scene/atlas_isometry.h"
#include "renderer/scene/atlas_overlap.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace celadon::atlas {
namespace {

/// A border shorter than this part of the longest is a hole to flatten around, not to cut open.
constexpr double kHole = 0.08;
/// Projection starts the descent if no more than this part of the area lands upside down.
constexpr double kProjectable = 0.03;
constexpr int kRigidIterations = 16;
/// Of the rigid energy per area: a chart above it will not come within any limits.
constexpr double kMostStretch = 0.06;
constexpr int kRescueIterations = 40;
constexpr int kFinalIterations = 30;
constexpr double kCoarse = 1e-4; ///< relative gain in energy below which a trial is good enough
constexpr double kFine = 1e-6;

/// Along the mean normal onto a plane.
/// @return the part of the area that lands upside down
double project(const Surface& surface, const ChartMesh& mesh, Planar& uv) {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    for (const int t : mesh.triangles) {
        axis += surface.areas[t] * surface.normals[t];
    }
    if (!(axis.norm() > 0.0)) {
        return 1.0;
    }
    axis.normalize();
    int smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    const Eigen::Vector3d x = axis.cross(Eigen::Vector3d::Unit(smallest)).normalized();
    const Eigen::Vector3d y = axis.cross(x);
    const Eigen::Vector3d& origin = surface.positions[mesh.surfaceVertices[0]];
    uv.resize(mesh.vertexCount());
    for (int v = 0; v < mesh.vertexCount(); ++v) {
        const Eigen::Vector3d p = surface.positions[mesh.surfaceVertices[v]] - origin;
        uv[v] = {p.dot(x), p.dot(y)};
    }
    double hidden = 0.0;
    double total = 0.0;
    for (const int t : mesh.triangles) {
        hidden += surface.normals[t].dot(axis) <= 0.0 ? surface.areas[t] : 0.0;
        total += surface.areas[t];
    }
    return hidden / total;
}

/// The longest border onto a circle of the chart's area, the inside in equilibrium of springs with
/// positive weights: no triangle turns over (Tutte 1963; Floater 1997). Holes are closed by a
/// vertex each.
bool embedInCircle(const Surface& surface, const ChartMesh& mesh,
                   const std::vector<RestTriangle>& rest, double area, Planar& uv) {
    const std::vector<int>& border = mesh.loops[0];
    const int holes = static_cast<int>(mesh.loops.size()) - 1;
    const int vertices = mesh.vertexCount() + holes;
    std::vector<int> unknown(vertices, 0);
    Planar all(vertices, Eigen::Vector2d::Zero());
    const double radius = std::sqrt(area / std::numbers::pi);
    double along = 0.0;
    for (std::size_t i = 0; i < border.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi * along / mesh.loopLengths[0];
        all[border[i]] = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        unknown[border[i]] = -1;
        along += (surface.positions[mesh.surfaceVertices[border[(i + 1) % border.size()]]] -
                  surface.positions[mesh.surfaceVertices[border[i]]])
                     .norm();
    }
    int count = 0;
    for (int& u : unknown) {
        u = u < 0 ? -1 : count++;
    }
    if (count > 0) {
        std::vector<Eigen::Triplet<double>> entries;
        Coordinates right = Coordinates::Zero(count, 2);
        const auto spring = [&](int a, int b, double weight) {
            for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
                if (unknown[i] < 0) {
                    continue;
                }
                entries.emplace_back(unknown[i], unknown[i], weight);
                if (unknown[j] < 0) {
                    right.row(unknown[i]) += weight * all[j].transpose();
                } else if (unknown[i] > unknown[j]) {
                    entries.emplace_back(unknown[i], unknown[j], -weight);
                }
            }
        };
        for (std::size_t t = 0; t < rest.size(); ++t) {
            for (int k = 0; k < 3; ++k) {
                const double cotangent = -rest[t].area * rest[t].gradients.col(k).dot(
                                                             rest[t].gradients.col((k + 1) % 3));
                spring(mesh.corners[t][k], mesh.corners[t][(k + 1) % 3],
                       std::clamp(cotangent, 0.05, 5.0));
            }
        }
        for (int hole = 0; hole < holes; ++hole) {
            for (const int v : mesh.loops[hole + 1]) {
                spring(mesh.vertexCount() + hole, v, 0.5);
            }
        }
        Eigen::SparseMatrix<double> matrix(count, count);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const PlanarSolver solver(matrix);
        if (!solver.isValid()) {
            return false;
        }
        const Coordinates inside = solver.solve(right);
        for (int v = 0; v < vertices; ++v) {
            if (unknown[v] >= 0) {
                all[v] = inside.row(unknown[v]).transpose();
            }
        }
    }
    uv.assign(all.begin(), all.begin() + mesh.vertexCount());
    return true;
}

/// Scales to the area on the surface, then measures.
void measure(const Surface& surface, const std::vector<RestTriangle>& rest, Chart& chart) {
    const ChartMesh& mesh = chart.mesh;
    double planar = 0.0;
    chart.area = 0.0;
    std::vector<Eigen::Matrix2d> jacobians(rest.size());
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const std::array<int, 3>& c = mesh.corners[t];
        jacobians[t] = rest[t].jacobian(chart.uv[c[0]], chart.uv[c[1]], chart.uv[c[2]]);
        planar += surface.areas[mesh.triangles[t]] * jacobians[t].determinant();
        chart.area += surface.areas[mesh.triangles[t]];
    }
    const double scale = planar > 0.0 && chart.area > 0.0 ? std::sqrt(chart.area / planar) : 1.0;
    for (Eigen::Vector2d& p : chart.uv) {
        p *= scale;
    }
    chart.distortion = {0.0, 0.0, 1.0};
    std::vector<std::pair<double, double>> worst; // distortion, area
    worst.reserve(rest.size());
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const Eigen::Matrix2d J = scale * jacobians[t];
        // Singular values from the conformal and anticonformal parts.
        const double similar = 0.5 * std::hypot(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
        const double mirrored = 0.5 * std::hypot(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
        const double largest = similar + mirrored;
        const double smallest = std::max(similar - mirrored, 1e-9 * largest);
        const double ratio = std::max(largest * smallest, 1e-9);
        const double weight = surface.areas[mesh.triangles[t]] / chart.area;
        chart.distortion.area += weight * std::max(ratio, 1.0 / ratio);
        chart.distortion.angle += weight * largest / smallest;
        worst.emplace_back(std::max(largest, 1.0 / std::max(smallest, 1e-9)), weight);
    }
    std::sort(worst.begin(), worst.end(), std::greater<>());
    double above = 0.0;
    for (const auto& [value, weight] : worst) {
        above += weight;
        if (above >= 0.01) {
            chart.distortion.worst = value;
            break;
        }
    }
}

bool within(const Distortion& d, const Distortion& limit) {
    return d.area <= limit.area && d.angle <= limit.angle && d.worst <= limit.worst;
}

/// The mesh as it is, holes staying holes.
bool flattenInto(const Surface& surface, const FlattenLimits& limits, Chart& chart) {
    const ChartMesh& mesh = chart.mesh;
    const std::vector<RestTriangle> rest = restShapes(surface, mesh);
    double area = 0.0;
    for (const RestTriangle& triangle : rest) {
        area += triangle.area;
    }
    const bool projectable = project(surface, mesh, chart.uv) < kProjectable;
    if (projectable && isOriented(mesh, rest, chart.uv)) {
        measure(surface, rest, chart);
        const Distortion& d = chart.distortion;
        if (std::max({d.area, d.angle, d.worst}) < 1.0 + 1e-6) {
            return !overlapsItself(mesh, chart.uv); // flat to begin with
        }
    }
    const PlanarSolver solver(laplacian(mesh, rest));
    if (!solver.isValid()) {
        return false;
    }
    Planar circle;
    if (!projectable) {
        if (!embedInCircle(surface, mesh, rest, area, circle)) {
            return false;
        }
        chart.uv = circle;
    }
    const double stretch = relaxRigid(mesh, rest, solver, kRigidIterations, kMostStretch, chart.uv);
    if (stretch > kMostStretch) {
        return false;
    }
    if (isOriented(mesh, rest, chart.uv)) {
        measure(surface, rest, chart);
        if (!within(chart.distortion, limits.distortion)) {
            relaxSymmetric(mesh, rest, solver, limits.polishIterations, kCoarse, chart.uv);
            measure(surface, rest, chart);
        }
    } else {
        // Start again from a map without fold-over and keep it so.
        if (circle.empty() && !embedInCircle(surface, mesh, rest, area, circle)) {
            return false;
        }
        chart.uv = std::move(circle);
        relaxSymmetric(mesh, rest, solver, kRescueIterations, kCoarse, chart.uv);
        if (!isOriented(mesh, rest, chart.uv)) {
            return false;
        }
        measure(surface, rest, chart);
    }
    return within(chart.distortion, limits.distortion) && !overlapsItself(mesh, chart.uv);
}

} // namespace

std::optional<Chart> flattenChart(const Surface& surface, ChartMesh mesh,
                                  const FlattenLimits& limits) {
    if (!mesh.isPlanarDomain()) {
        return std::nullopt;
    }
    Chart chart;
    chart.mesh = std::move(mesh);
    if (flattenInto(surface, limits, chart)) {
        return chart;
    }
    if (cutToDisk(surface, chart.mesh, kHole) && chart.mesh.isPlanarDomain() &&
        flattenInto(surface, limits, chart)) {
        return chart;
    }
    return std::nullopt;
}

void polishChart(const Surface& surface, Chart& chart) {
    if (std::max({chart.distortion.area, chart.distortion.angle, chart.distortion.worst}) <
        1.0 + 1e-6) {
        return;
    }
    const std::vector<RestTriangle> rest = restShapes(surface, chart.mesh);
    const PlanarSolver solver(laplacian(chart.mesh, rest));
    if (!solver.isValid()) {
        return;
    }
    Chart polished = chart;
    relaxSymmetric(chart.mesh, rest, solver, kFinalIterations, kFine, polished.uv);
    if (isOriented(chart.mesh, rest, polished.uv) && !overlapsItself(chart.mesh, polished.uv)) {
        measure(surface, rest, polished);
        chart = std::move(polished);
    }
}

} // namespace celadon::atlas
