#include "renderer/scene/handle_solver.h"

#include "renderer/scene/handle_ground.h"
#include "renderer/scene/rigid_solver.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace celadon {

namespace {

constexpr int kMostIterations = 100;
constexpr double kStill = 1e-5; ///< of the size of the whole: it has settled
constexpr double kStillInPreview = 1e-3;
constexpr std::uint32_t kNone = WeldedWorld::kNone;

/// Points that move with handles, and the solver for the others.
struct Level {
    const SurfaceGraph& graph;
    std::vector<std::uint32_t> held;     ///< points, sorted
    std::vector<std::uint32_t> handleOf; ///< of each of them
    std::optional<RigidSolver> solver;

    /// @param nodes outlive this @throws InputError
    Level(const SurfaceGraph& nodes, const std::vector<PlacedHandle>& handles) : graph(nodes) {
        std::vector<std::uint32_t> owner(graph.points.size(), kNone);
        for (std::uint32_t h = 0; h < handles.size(); ++h) {
            const std::uint32_t next = nearestPoint(graph.points, handles[h].at);
            if (owner[next] != kNone) {
                throw InputError(fmt::format("handle {}", h),
                                 fmt::format("has no vertex of its own: handle {} holds the "
                                             "nearest",
                                             owner[next]),
                                 "move one of them, or make the other smaller");
            }
            owner[next] = h;
            for (std::uint32_t i = 0; i < owner.size(); ++i) {
                if (owner[i] == kNone &&
                    glm::length(graph.points[i] - handles[h].at) <= handles[h].radiusMm) {
                    owner[i] = h;
                }
            }
        }
        for (std::uint32_t i = 0; i < owner.size(); ++i) {
            if (owner[i] != kNone) {
                held.push_back(i);
                handleOf.push_back(owner[i]);
            }
        }
        solver.emplace(graph, held);
    }

    void setTargets(const std::vector<PlacedHandle>& handles) {
        std::vector<HeldPoint> targets;
        for (std::size_t k = 0; k < held.size(); ++k) {
            const PlacedHandle& handle = handles[handleOf[k]];
            targets.push_back(
                {handle.to + handle.turn * (graph.points[held[k]] - handle.at), handle.turn});
        }
        solver->setTargets(targets);
    }
};

double milliseconds(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since)
        .count();
}

} // namespace

struct HandleSolver::State {
    std::shared_ptr<const GroundNodes> nodes;
    std::optional<Level> fine;
    std::optional<Level> coarse; ///< the guess to start from
    std::vector<std::string> warnings;
    double size = 0.0; ///< mm
    std::vector<PlacedHandle> solvedHandles;
    Settling solvedTo = Settling::Full;
    std::shared_ptr<const NodePose> solved;
    Effort effort;

    State(const World& rest, const std::vector<PlacedHandle>& handles) {
        CELADON_ASSERT(!handles.empty());
        const auto ground =
            rest.handleGround ? rest.handleGround : std::make_shared<HandleGround>();
        const std::shared_ptr<const WeldedWorld> surface = ground->surface(rest);
        nodes = ground->nodes(rest, handles);
        size = rest.sceneSphere.radius;
        effort.vertices = surface->graph.points.size();
        effort.nodes = nodes->graph.points.size();
        fine.emplace(nodes->graph, handles);
        if (nodes->coarse) {
            try {
                coarse.emplace(nodes->coarse->graph, handles);
            } catch (const InputError&) { // two handles within one of its few points: no guess
                coarse.reset();
            }
        }
        const auto without = std::count(nodes->hasHandle.begin(), nodes->hasHandle.end(), false);
        if (without > 0) {
            warnings.push_back(fmt::format("handles: {} of the model's {} separate parts hold none "
                                           "and are carried along by what is next to them",
                                           without, surface->components));
        }
        if (surface->unused > 0) {
            warnings.push_back(fmt::format("handles: {} vertices belong to no triangle with an "
                                           "area, and stay",
                                           surface->unused));
        }
    }

    /// A few points settle first and carry the nodes to where their own search begins.
    void start(const std::vector<PlacedHandle>& handles, double still) {
        fine->setTargets(handles);
        if (!coarse) {
            fine->solver->startFromHeld();
            return;
        }
        coarse->setTargets(handles);
        coarse->solver->startFromHeld();
        coarse->solver->settle(still, kMostIterations);
        const NodePose pose{nodes->coarse->binding, coarse->solver->nodes()};
        std::vector<MovedNode> guess;
        for (const VertexNodes& node : nodes->coarse->nodes) {
            const Mapped mapped = followNodes(node, pose);
            guess.push_back({mapped.position, mapped.jacobian});
        }
        fine->solver->start(guess);
        fine->setTargets(handles);
    }
};

HandleSolver::HandleSolver(const World& rest, const std::vector<PlacedHandle>& handles)
    : mState(std::make_unique<State>(rest, handles)) {}
HandleSolver::~HandleSolver() = default;
HandleSolver::HandleSolver(HandleSolver&&) noexcept = default;
HandleSolver& HandleSolver::operator=(HandleSolver&&) noexcept = default;

const std::vector<std::string>& HandleSolver::warnings() const {
    return mState->warnings;
}

const HandleSolver::Effort& HandleSolver::effort() const {
    return mState->effort;
}

std::shared_ptr<const NodePose> HandleSolver::solve(const std::vector<PlacedHandle>& handles,
                                                    Settling settling) {
    State& s = *mState;
    if (s.solved && s.solvedTo == settling && s.solvedHandles == handles) {
        return s.solved;
    }
    const double still = s.size * (settling == Settling::Full ? kStill : kStillInPreview);
    const auto start = std::chrono::steady_clock::now();
    s.start(handles, still);
    const auto guessed = std::chrono::steady_clock::now();
    s.effort.iterations = s.fine->solver->settle(still, kMostIterations);
    s.effort.msPerIteration = milliseconds(guessed) / s.effort.iterations;
    s.solved =
        std::make_shared<const NodePose>(NodePose{s.nodes->binding, s.fine->solver->nodes()});
    s.solvedHandles = handles;
    s.solvedTo = settling;
    s.effort.ms = milliseconds(start);
    return s.solved;
}

} // namespace celadon
