#pragma once

#include "renderer/scene/scene.h"

/// Meshes for testing the atlas: benign, awkward and hostile ones, made in code.
namespace celadon::test {

[[nodiscard]] Mesh makeSphere(int slices, int stacks, glm::vec3 center = {}, float radius = 1.0f);
[[nodiscard]] Mesh makeTorus(int around, int across);
[[nodiscard]] Mesh makeCube();
[[nodiscard]] Mesh makeCylinder(int slices, int stacks); ///< open at both ends
[[nodiscard]] Mesh makeMoebiusStrip(int segments);
[[nodiscard]] Mesh makeManyTetrahedra(int count, unsigned seed);
/// Triangles over random vertices of a small set: edges with many triangles, winding at random.
[[nodiscard]] Mesh makeSoup(int vertices, int triangles, unsigned seed);
/// A fan of pages around one spine: an edge with `pages` triangles.
[[nodiscard]] Mesh makeBook(int pages);

void append(Mesh& mesh, const Mesh& other);
/// Every triangle with vertices of its own.
[[nodiscard]] Mesh exploded(const Mesh& mesh);
/// Every third triangle wound the other way.
[[nodiscard]] Mesh inconsistentlyWound(Mesh mesh);

/// Reads positions and faces of a test model (.obj; .ply with float positions first).
[[nodiscard]] Mesh readTestModel(const std::string& file);

} // namespace celadon::test
