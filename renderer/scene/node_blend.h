#pragma once

#include "renderer/scene/lattice.h"
#include "renderer/scene/pose_mesh.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

/// Vertices that follow nodes, each of which carries the space around it by an affine map: how what
/// handles do to a few nodes reaches every vertex (Sumner, Schmid, Pauly 2007, "Embedded
/// deformation for shape manipulation", with weights that have no kink). The rest shape is moved,
/// before skins, animations and deformers. The same in shaders/handles.comp.
namespace celadon {

inline constexpr std::uint32_t kNoNode = ~0u;

/// What one vertex follows. No node: it stays. One node: that, all of it. Five nodes, by distance:
/// the first four, with weights (1 - d^2 / D^2)^2, D the distance of the fifth: where the set of
/// the nearest changes, the weight of what comes and goes is 0, and so is its slope.
struct VertexNodes {
    glm::vec3 at{0.0f}; ///< at rest, mm
    std::array<std::uint32_t, 5> nodes{kNoNode, kNoNode, kNoNode, kNoNode, kNoNode};
};

/// Everything that stays while handles move.
struct NodeBinding {
    std::vector<glm::dvec3> places;                 ///< of nodes at rest, mm
    std::vector<std::vector<VertexNodes>> vertices; ///< [mesh of the world][vertex]
    std::vector<MeshPose> restPoses;                ///< of meshes that are bound; else empty ones
};

/// Where a node is, and what it does to the space around it: q' + linear (p - q).
struct MovedNode {
    glm::dvec3 to{0.0};
    glm::dmat3 linear{1.0};
};

struct NodePose {
    std::shared_ptr<const NodeBinding> binding;
    std::vector<MovedNode> nodes;
};

/// Where a vertex goes, and the derivative of that by its place at rest.
[[nodiscard]] Mapped followNodes(const VertexNodes& vertex, const NodePose& pose);

/// The affine map of a vertex, of which followNodes() is the value and the slope, as one matrix.
[[nodiscard]] glm::dmat4 affineAt(const VertexNodes& vertex, const NodePose& pose);

} // namespace celadon
