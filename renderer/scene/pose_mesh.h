#pragma once

#include "renderer/scene/animation.h"
#include "renderer/scene/rig.h"
#include "renderer/scene/scene.h"

#include <vector>

/// Skinning and morphing of one mesh on the CPU in double precision: what loading, `info
/// --write-mesh` and the references use, and what the GPU is tested against.
namespace celadon {

/// What one mesh needs of a pose.
struct MeshPose {
    /// With a skin: of each joint, times its inverse bind matrix, and of the mesh's node last; else
    /// of the node alone. Empty: the mesh has no binding, and stays as it is.
    std::vector<glm::dmat4> matrices;
    std::vector<double> weights; ///< of morph targets; absent ones are 0
};

/// @param unit scales the result: millimeters per model unit, or 1
[[nodiscard]] MeshPose meshPose(const Rig& rig, const MeshBinding& binding, const RigPose& pose,
                                double unit);

struct PosedVertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals; ///< unit length, or zero where none is defined; empty: flat
    std::vector<bool> mirrored;      ///< the vertex's matrix turns the front to the back
};

/// With the morph targets on, in the space of the binding: normals of any length, nothing mirrored.
[[nodiscard]] PosedVertices morphedVertices(const MeshBinding& binding,
                                            const std::vector<double>& weights);

/// glTF 2.0, 3.7.2.2 (morph targets first) and 3.7.3.3. Normals go by the inverse transpose of the
/// blended matrix, as the limit where that is singular.
[[nodiscard]] PosedVertices poseVertices(const MeshBinding& binding, const MeshPose& pose);

/// The matrix of one vertex of the binding.
[[nodiscard]] glm::dmat4 blendedMatrix(const MeshBinding& binding, const MeshPose& pose,
                                       std::size_t vertex);

/// @return unit length, or zero where none is defined
[[nodiscard]] glm::dvec3 carryNormal(const glm::dmat4& matrix, const glm::dvec3& normal);

/// Carries normals: the inverse transpose times the determinant, which exists for flat scales too.
[[nodiscard]] glm::dmat3 cofactors(const glm::dmat3& m);

} // namespace celadon
