#pragma once

#include "renderer/scene/atlas_chart_mesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

/// Each triangle laid flat by itself: the shape that flattening strives to keep.
namespace celadon::atlas {

using Planar = std::vector<Eigen::Vector2d>; ///< a position per local vertex of a chart

struct RestTriangle {
    /// Columns: how the Jacobian depends on the three corners, J = sum of u_i g_i^T.
    Eigen::Matrix<double, 2, 3> gradients;
    double area = 0.0; ///< > 0; of a sliver: that of the fatter one that stands for it

    [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                           const Eigen::Vector2d& c) const {
        return a * gradients.col(0).transpose() + b * gradients.col(1).transpose() +
               c * gradients.col(2).transpose();
    }
};

/// Slivers and triangles without area get a height of a thousandth of their longest side, so that
/// all systems stay well conditioned and every triangle has an orientation to keep.
[[nodiscard]] std::vector<RestTriangle> restShapes(const Surface& surface, const ChartMesh& mesh);

/// Sum of A g_i g_j^T over the triangles (the cotangent Laplacian), made definite by holding
/// vertex 0 in place; lower triangle only.
[[nodiscard]] Eigen::SparseMatrix<double> laplacian(const ChartMesh& mesh,
                                                    const std::vector<RestTriangle>& rest);

} // namespace celadon::atlas
