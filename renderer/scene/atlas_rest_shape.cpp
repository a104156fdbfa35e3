#include "renderer/scene/atlas_rest_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace celadon::atlas {
namespace {

constexpr double kThinnest = 1e-3;

RestTriangle restTriangle(const std::array<Eigen::Vector3d, 3>& p) {
    // The longest side lies on the x axis, whichever it is, so that clamping the height is enough.
    int k = 0;
    double longest = -1.0;
    for (int i = 0; i < 3; ++i) {
        const double length = (p[(i + 1) % 3] - p[i]).stableNorm();
        if (length > longest) {
            longest = length;
            k = i;
        }
    }
    const Eigen::Vector3d along = (p[(k + 1) % 3] - p[k]) / longest;
    const Eigen::Vector3d toApex = p[(k + 2) % 3] - p[k];
    const double x = std::clamp(toApex.dot(along), 0.0, longest);
    const double y = std::max((toApex - toApex.dot(along) * along).norm(), kThinnest * longest);
    RestTriangle rest;
    rest.area = 0.5 * longest * y;
    // Inverse of [[longest, x], [0, y]]; its rows are the gradients of the second and third corner.
    const Eigen::Vector2d g1(1.0 / longest, -x / (longest * y));
    const Eigen::Vector2d g2(0.0, 1.0 / y);
    rest.gradients.col(k) = -g1 - g2;
    rest.gradients.col((k + 1) % 3) = g1;
    rest.gradients.col((k + 2) % 3) = g2;
    return rest;
}

} // namespace

std::vector<RestTriangle> restShapes(const Surface& surface, const ChartMesh& mesh) {
    std::vector<RestTriangle> rest;
    rest.reserve(mesh.corners.size());
    for (const int t : mesh.triangles) {
        const std::array<int, 3>& v = surface.triangles[t];
        rest.push_back(restTriangle(
            {surface.positions[v[0]], surface.positions[v[1]], surface.positions[v[2]]}));
    }
    return rest;
}

Eigen::SparseMatrix<double> laplacian(const ChartMesh& mesh,
                                      const std::vector<RestTriangle>& rest) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(6 * rest.size() + 1);
    double largest = 0.0;
    for (std::size_t t = 0; t < rest.size(); ++t) {
        const Eigen::Matrix3d local =
            rest[t].area * rest[t].gradients.transpose() * rest[t].gradients;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                const int row = mesh.corners[t][i];
                const int column = mesh.corners[t][j];
                if (row >= column) {
                    entries.emplace_back(row, column, local(i, j));
                }
            }
            largest = std::max(largest, local(i, i));
        }
    }
    entries.emplace_back(0, 0, std::max(largest, 1.0));
    Eigen::SparseMatrix<double> matrix(mesh.vertexCount(), mesh.vertexCount());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace celadon::atlas
