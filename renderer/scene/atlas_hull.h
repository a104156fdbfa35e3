#pragma once

#include <Eigen/Core>

#include <vector>

namespace celadon::atlas {

/// Counterclockwise, without repeated or collinear points.
[[nodiscard]] std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

/// By which angle to turn a shape so that its bounding box is smallest, its longer side along x.
[[nodiscard]] double boxAngle(const std::vector<std::vector<Eigen::Vector2d>>& loops);

} // namespace celadon::atlas
