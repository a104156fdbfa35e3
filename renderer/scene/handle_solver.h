#pragma once

#include "renderer/scene/animated_deformer.h"
#include "renderer/scene/node_blend.h"
#include "renderer/scene/world.h"

#include <memory>
#include <string>
#include <vector>

/// Handles on a world at rest: parts of its surface that are held or dragged, and the rest of it
/// follows as rigidly as possible (rigid_solver.h). The nodes that are moved are vertices, or stand
/// for those around them (handle_ground.h). Vertices at equal positions are one, whichever meshes
/// they belong to.
namespace celadon {

/// How far the search for a pose goes.
enum class Settling {
    Full,   ///< until nothing moves
    Preview ///< until little moves: what is seen while a handle is dragged
};

class HandleSolver {
public:
    /// Factors the system of the nodes, once World::handleGround has them: which can take seconds.
    /// @param handles where they are at rest; at least one
    /// @throws InputError: no triangles; a handle that has no vertex of its own
    HandleSolver(const World& rest, const std::vector<PlacedHandle>& handles);
    ~HandleSolver();
    HandleSolver(HandleSolver&&) noexcept;
    HandleSolver& operator=(HandleSolver&&) noexcept;

    /// What the user should know: parts without a handle are carried along, and so on.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

    /// Depends on the handles alone, not on where they were before.
    /// @param handles those of the constructor, moved
    [[nodiscard]] std::shared_ptr<const NodePose> solve(const std::vector<PlacedHandle>& handles,
                                                        Settling settling = Settling::Full);

    struct Effort {
        std::size_t vertices = 0; ///< welded
        std::size_t nodes = 0;
        int iterations = 0; ///< of the last solve, on all nodes
        double msPerIteration = 0.0;
        double ms = 0.0; ///< of the last solve, all of it
    };
    [[nodiscard]] const Effort& effort() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

} // namespace celadon
