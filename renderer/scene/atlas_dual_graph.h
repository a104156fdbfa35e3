#pragma once

#include "renderer/scene/atlas_chart_mesh.h"

#include <Eigen/Core>

#include <span>
#include <vector>

/// Triangles as nodes, shared edges as links: what charts are grown on.
namespace celadon::atlas {

struct DualGraph {
    std::vector<int> neighbors; ///< 3 per node, in the order of the half-edges; -1: border
    std::vector<double> edgeLengths;
    std::vector<Eigen::Vector3d> centers;
    std::vector<Eigen::Vector3d> normals; ///< smoothed, not of unit length where they disagree
    std::vector<Eigen::Vector3d> faceNormals;
    std::vector<double> areas;

    [[nodiscard]] int size() const { return static_cast<int>(areas.size()); }
};

/// @param smoothingRadius over which normals are averaged, so that growth follows the shape and
///                        not its roughness
[[nodiscard]] DualGraph buildDualGraph(const Surface& surface, double smoothingRadius);

/// The part of `graph` that a chart covers, nodes in the order of `mesh.triangles`; links as the
/// chart has them, cuts included.
[[nodiscard]] DualGraph restrictTo(const DualGraph& graph, const ChartMesh& mesh);

/// Connected sets of equal label.
/// @return a number per node, from 0 in the order of first nodes
[[nodiscard]] std::vector<int> connectedParts(const DualGraph& graph, std::span<const int> labels);

} // namespace celadon::atlas
