#pragma once

#include "renderer/scene/node_blend.h"
#include "renderer/scene/surface_graph.h"

#include <glm/glm.hpp>

#include <memory>
#include <span>
#include <vector>

/// As-rigid-as-possible surface modeling (Sorkine, Alexa 2007): points that are held go where they
/// are told, the rest follows such that the surroundings of each point are turned, and stretched as
/// little as can be. Cotangent weights; the system of the global step is factored once.
namespace celadon {

/// Of one point that is held.
struct HeldPoint {
    glm::dvec3 to{0.0};
    glm::dmat3 turn{1.0};
};

class RigidSolver {
public:
    /// @param graph each component of which has a point that is held; outlives the solver
    /// @param held  points that are held, sorted, each once
    RigidSolver(const SurfaceGraph& graph, std::vector<std::uint32_t> held);
    ~RigidSolver();
    RigidSolver(RigidSolver&&) noexcept;
    RigidSolver& operator=(RigidSolver&&) noexcept;

    /// Where to start from: a place and a turn for every point.
    void start(std::span<const MovedNode> guess);
    /// From turns that run smoothly (harmonically) between those of the held points, and the places
    /// that fit them best: exact where all are held by one rigid motion.
    void startFromHeld();
    /// @param targets of the held points, in order
    void setTargets(std::span<const HeldPoint> targets);
    /// A local and a global step.
    /// @return how far the point that moved most moved, mm
    double iterate();
    /// Such steps, each from where those before seem to lead, until one moves no point farther.
    /// @param still mm
    /// @return how many
    int settle(double still, int mostIterations);
    /// The sum over edges of w |p'_ij - R_i p_ij|^2, mm^2: no iteration makes it greater.
    [[nodiscard]] double energy() const;

    [[nodiscard]] std::span<const glm::dvec3> positions() const;
    [[nodiscard]] std::span<const glm::dmat3> rotations() const;
    /// With the linear map that fits the edges and the normal at each point best; where it has no
    /// triangles, its rotation.
    [[nodiscard]] std::vector<MovedNode> nodes() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

} // namespace celadon
