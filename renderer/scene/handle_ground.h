#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/node_blend.h"
#include "renderer/scene/surface_graph.h"
#include "renderer/scene/world.h"

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

/// What handles need to know of a world at rest, wherever they are: its meshes as one surface, and
/// the nodes that stand for it. It takes seconds for a million triangles, so it is made when it is
/// first needed and then kept for all who move the world, on any thread.
namespace celadon {

/// Up to kMostNodes vertices are nodes themselves; of larger models some kClusterNodes points,
/// spread over the surface, carry the vertices around them.
inline constexpr std::size_t kMostNodes = 20000;
inline constexpr std::size_t kClusterNodes = 4000;

/// All meshes, welded at equal positions.
struct WeldedWorld {
    static constexpr std::uint32_t kNone = ~0u;
    SurfaceGraph graph;
    std::vector<std::vector<std::uint32_t>> pointOf; ///< [mesh][vertex]; kNone: no triangle has it
    std::size_t unused = 0;                          ///< such vertices
    std::vector<std::uint32_t> component;            ///< of each point
    std::uint32_t components = 0;
};

/// Nodes of the components that hold handles.
struct GroundNodes {
    std::vector<bool> hasHandle; ///< [component]
    SurfaceGraph graph;
    std::shared_ptr<const NodeBinding> binding;
    /// A few of them, where a guess to start from costs next to nothing.
    struct Coarse {
        SurfaceGraph graph;
        std::vector<VertexNodes> nodes; ///< what each node of the finer graph follows
        std::shared_ptr<const NodeBinding> binding;
    };
    std::optional<Coarse> coarse;
};

class HandleGround {
public:
    /// @param rest always the same one
    /// @throws InputError: no triangles
    [[nodiscard]] std::shared_ptr<const WeldedWorld> surface(const World& rest);
    /// Kept until handles on other components are asked for.
    [[nodiscard]] std::shared_ptr<const GroundNodes>
    nodes(const World& rest, const std::vector<PlacedHandle>& handles);

private:
    std::mutex mMutex;
    std::shared_ptr<const WeldedWorld> mSurface;
    std::shared_ptr<const GroundNodes> mNodes;
};

/// The point that is nearest; the first of several.
[[nodiscard]] std::uint32_t nearestPoint(std::span<const glm::dvec3> points, const glm::dvec3& p);

} // namespace celadon
