#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

/// Puts shapes into the unit square at one common scale.
namespace celadon::atlas {

struct Outline {
    std::vector<std::vector<Eigen::Vector2d>> loops; ///< closed; the outside one and holes
    double area = 0.0;
};

/// p -> linear p + offset, in the unit square.
struct Placement {
    Eigen::Matrix2d linear = Eigen::Matrix2d::Identity(); ///< a rotation times the scale
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
};

struct Packing {
    std::vector<Placement> placements; ///< one per outline
    int gutterTexels = 0; ///< held; less than asked for only when so many shapes leave no choice
};

/// The largest scale found at which all shapes fit with the gutters. True shapes, rotated, one
/// after another to the lowest free place; texels of `resolution` touched by two shapes, or by a
/// shape and the border, have at least `gutterTexels` free ones between them. Shapes of less than a
/// texel are enlarged to about one.
[[nodiscard]] Packing pack(std::span<const Outline> outlines, int resolution, int gutterTexels);

} // namespace celadon::atlas
