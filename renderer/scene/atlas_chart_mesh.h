#pragma once

#include "renderer/scene/atlas_surface.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

/// A connected set of surface triangles with its own vertices: manifold by construction, since
/// corners are joined only across twin half-edges inside the set.
namespace celadon::atlas {

struct ChartMesh {
    std::vector<int> triangles;              ///< of the surface, ascending
    std::vector<std::array<int, 3>> corners; ///< local vertices of each triangle
    std::vector<int> twins;                  ///< local half-edges, -1: border
    std::vector<int> surfaceVertices;        ///< local vertex -> Surface::positions
    std::vector<std::vector<int>> loops;     ///< borders as local vertices, longest (3D) first
    std::vector<double> loopLengths;

    [[nodiscard]] int triangleCount() const { return static_cast<int>(triangles.size()); }
    [[nodiscard]] int vertexCount() const { return static_cast<int>(surfaceVertices.size()); }
    [[nodiscard]] int eulerCharacteristic() const;
    /// A sphere with holes, at least one: what can lie in the plane without a cut through it.
    [[nodiscard]] bool isPlanarDomain() const {
        return !loops.empty() && eulerCharacteristic() + static_cast<int>(loops.size()) == 2;
    }
};

/// @param triangles ascending
[[nodiscard]] ChartMesh buildChartMesh(const Surface& surface, std::vector<int> triangles);

/// Cuts along the shortest paths that join all long borders into one, so that a tube can be rolled
/// out. Borders shorter than `shortLoop` times the longest stay holes.
/// @return false when there was nothing to cut
bool cutToDisk(const Surface& surface, ChartMesh& mesh, double shortLoop);

} // namespace celadon::atlas
