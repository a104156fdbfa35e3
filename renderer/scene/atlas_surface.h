#pragma once

#include "renderer/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// The triangles of all meshes as one oriented surface, whatever the soup they came as: the first
/// step of the automatic atlas (atlas.h).
namespace celadon::atlas {

struct SourceTriangle {
    int mesh = 0;
    int triangle = 0;
};

/// Half-edge 3 t + k runs from corner k to corner k + 1 of triangle t.
struct Surface {
    std::vector<Eigen::Vector3d> positions;    ///< welded; centered, bounding box diagonal 1
    std::vector<std::array<int, 3>> triangles; ///< three distinct welded vertices each
    std::vector<int> twins;                    ///< half-edge -> the opposite one, -1: border
    std::vector<Eigen::Vector3d> normals;      ///< unit; zero for a triangle without area
    std::vector<double> areas;
    std::vector<SourceTriangle> sources;  ///< where each triangle came from
    std::vector<SourceTriangle> dropped;  ///< triangles that no chart can show
    std::vector<std::vector<int>> welded; ///< mesh, vertex -> index into positions
    double totalArea = 0.0;

    [[nodiscard]] int triangleCount() const { return static_cast<int>(triangles.size()); }
};

/// Welds vertices of equal position within each mesh and pairs half-edges. Twins always run in
/// opposite directions, so a surface patch joined over twins is oriented as its triangles are
/// wound; at an edge of more than two triangles, those that continue each other best are paired.
/// Left out (`dropped`): triangles with two corners at one place, and connected parts whose area is
/// nothing beside the rest.
/// @throws InputError for a vertex that is not finite, or a mesh without a triangle of positive
/// area
[[nodiscard]] Surface buildSurface(std::span<const Mesh* const> meshes);

} // namespace celadon::atlas
