#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Points on a surface and which of them are neighbors: a mesh welded at equal positions, or a
/// coarser one in its place whose points are spread evenly.
namespace celadon {

using Triangle = std::array<std::uint32_t, 3>;

struct SurfaceGraph {
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles; ///< of three different points each
    /// Neighbors of point i: neighbors[starts[i]] ... neighbors[starts[i + 1] - 1], sorted.
    std::vector<std::size_t> starts;
    std::vector<std::uint32_t> neighbors;

    [[nodiscard]] std::span<const std::uint32_t> neighborsOf(std::size_t point) const {
        return std::span(neighbors).subspan(starts[point], starts[point + 1] - starts[point]);
    }
};

/// @param edges pairs of points in any order, more than once or not; those of triangles included
[[nodiscard]] SurfaceGraph makeGraph(std::vector<glm::dvec3> points,
                                     std::vector<Triangle> triangles,
                                     std::span<const std::array<std::uint32_t, 2>> edges);
/// With the edges of its triangles.
[[nodiscard]] SurfaceGraph makeGraph(std::vector<glm::dvec3> points,
                                     std::vector<Triangle> triangles);

/// @return a number from 0 for each point: which connected component it belongs to
[[nodiscard]] std::vector<std::uint32_t> components(const SurfaceGraph& graph);

/// A graph of about `count` of the points, each of which stands for those that it is next to along
/// the surface.
struct Clusters {
    SurfaceGraph graph;
    std::vector<std::uint32_t> chosen;    ///< of each of its points, the original one
    std::vector<std::uint32_t> clusterOf; ///< of each original point
};
/// At least one point of each component is chosen, and two points are linked where their clusters
/// touch: what was connected stays so, and what was apart too.
[[nodiscard]] Clusters clusterSurface(const SurfaceGraph& graph, std::size_t count);

/// Nearest first, of all that a walk of up to two links from `around` meets, itself included.
/// @return at most five
[[nodiscard]] std::vector<std::uint32_t> nearestAround(const SurfaceGraph& graph,
                                                       std::uint32_t around, const glm::dvec3& p);

} // namespace celadon
