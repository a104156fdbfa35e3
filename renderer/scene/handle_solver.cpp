#include "renderer/scene/handle_solver.h"

#include "renderer/scene/rigid_solver.h"
#include "renderer/scene/surface_graph.h"
#include "renderer/scene/weld_vertices.h"
#include "subedit/assert.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

namespace celadon {

namespace {

constexpr std::size_t kCoarseNodes = 500; ///< a guess to start from costs next to nothing there
constexpr int kMostIterations = 100;
constexpr double kStill = 1e-5; ///< of the size of the whole: it has settled
constexpr double kStillInPreview = 1e-3;
constexpr std::uint32_t kNone = ~0u;

/// All meshes as one surface.
struct WeldedWorld {
    SurfaceGraph graph;
    std::vector<std::vector<std::uint32_t>> pointOf; ///< [mesh][vertex]; kNone: no triangle has it
    std::size_t unused = 0;                          ///< such vertices
};

WeldedWorld weld(const World& rest) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> corners;
    for (const WorldMesh& part : rest.meshes) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), part.mesh.positions.begin(), part.mesh.positions.end());
        for (const std::uint32_t i : part.mesh.indices) {
            corners.push_back(first + i);
        }
    }
    const std::vector<std::uint32_t> group = weldVertices(positions);
    std::vector<std::uint32_t> number(positions.size(), kNone);
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        const Triangle welded{group[corners[t]], group[corners[t + 1]], group[corners[t + 2]]};
        if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) {
            continue;
        }
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& point = number[welded[k]];
            if (point == kNone) {
                point = static_cast<std::uint32_t>(points.size());
                points.emplace_back(positions[welded[k]]);
            }
            triangle[k] = point;
        }
        triangles.push_back(triangle);
    }
    WeldedWorld result;
    result.graph = makeGraph(std::move(points), std::move(triangles));
    std::size_t at = 0;
    for (const WorldMesh& part : rest.meshes) {
        std::vector<std::uint32_t>& mesh = result.pointOf.emplace_back();
        for (std::size_t i = 0; i < part.mesh.positions.size(); ++i, ++at) {
            mesh.push_back(number[group[at]]);
            result.unused += mesh.back() == kNone ? 1 : 0;
        }
    }
    return result;
}

/// The points for which `keeps` holds, and what lies between them.
struct Part {
    SurfaceGraph graph;
    std::vector<std::uint32_t> numberOf; ///< of each point of the whole; kNone: not in it
};

template<typename Keeps>
Part partOf(const SurfaceGraph& whole, const Keeps& keeps) {
    Part part;
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i < whole.points.size(); ++i) {
        part.numberOf.push_back(keeps(i) ? static_cast<std::uint32_t>(points.size()) : kNone);
        if (keeps(i)) {
            points.push_back(whole.points[i]);
        }
    }
    std::vector<Triangle> triangles;
    for (const Triangle& t : whole.triangles) {
        const Triangle mapped{part.numberOf[t[0]], part.numberOf[t[1]], part.numberOf[t[2]]};
        if (mapped[0] != kNone) { // a component is in it whole or not at all
            triangles.push_back(mapped);
        }
    }
    part.graph = makeGraph(std::move(points), std::move(triangles));
    return part;
}

std::uint32_t nearest(std::span<const glm::dvec3> points, const glm::dvec3& p) {
    const auto closer = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
    };
    return static_cast<std::uint32_t>(std::min_element(points.begin(), points.end(), closer) -
                                      points.begin());
}

VertexNodes follow(const glm::dvec3& p, std::span<const std::uint32_t> nodes) {
    VertexNodes result;
    result.at = glm::vec3(p);
    std::copy(nodes.begin(), nodes.end(), result.nodes.begin());
    return result;
}

/// Points that move with handles, and the solver for the others.
struct Level {
    SurfaceGraph graph;
    std::vector<std::uint32_t> held;     ///< points, sorted
    std::vector<std::uint32_t> handleOf; ///< of each of them
    std::optional<RigidSolver> solver;

    /// @throws InputError
    void hold(const std::vector<PlacedHandle>& handles) {
        std::vector<std::uint32_t> owner(graph.points.size(), kNone);
        for (std::uint32_t h = 0; h < handles.size(); ++h) {
            const std::uint32_t next = nearest(graph.points, handles[h].at);
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
    Level fine;                              ///< nodes
    std::optional<Level> coarse;             ///< a few of them; the guess to start from
    std::vector<VertexNodes> fineFromCoarse; ///< [node]
    std::shared_ptr<NodeBinding> coarseBinding;
    std::shared_ptr<NodeBinding> binding;
    std::vector<std::string> warnings;
    double size = 0.0; ///< mm
    std::vector<PlacedHandle> solvedHandles;
    Settling solvedTo = Settling::Full;
    std::shared_ptr<const NodePose> solved;
    Effort effort;

    State(const World& rest, const std::vector<PlacedHandle>& handles) {
        CELADON_ASSERT(!handles.empty());
        size = rest.sceneSphere.radius;
        const WeldedWorld world = weld(rest);
        effort.vertices = world.graph.points.size();
        if (world.graph.points.empty()) {
            throw InputError("the handles", "there is no triangle that has an area to hold",
                             "check the model");
        }
        const std::vector<std::uint32_t> component = components(world.graph);
        const std::uint32_t count = 1 + *std::max_element(component.begin(), component.end());
        std::vector<bool> hasHandle(count, false);
        for (const PlacedHandle& handle : handles) {
            hasHandle[component[nearest(world.graph.points, handle.at)]] = true;
        }
        const Part part =
            partOf(world.graph, [&](std::uint32_t i) { return hasHandle[component[i]]; });
        std::vector<VertexNodes> ofPart = makeNodes(part.graph, handles);
        addCoarse(handles);
        bindVertices(rest, world, component, part, ofPart);
        const auto without = std::count(hasHandle.begin(), hasHandle.end(), false);
        if (without > 0) {
            warnings.push_back(fmt::format("handles: {} of the model's {} separate parts hold none "
                                           "and are carried along by what is next to them",
                                           without, count));
        }
        if (world.unused > 0) {
            warnings.push_back(fmt::format("handles: {} vertices belong to no triangle with an "
                                           "area, and stay",
                                           world.unused));
        }
    }

    /// The nodes of the parts that have handles. @return what each of their points follows
    std::vector<VertexNodes> makeNodes(const SurfaceGraph& part,
                                       const std::vector<PlacedHandle>& handles) {
        std::vector<VertexNodes> result;
        if (part.points.size() <= kMostNodes) {
            fine.graph = part;
            for (std::uint32_t i = 0; i < part.points.size(); ++i) {
                result.push_back(follow(part.points[i], std::span(&i, 1)));
            }
        } else {
            result = followClusters(part, kClusterNodes, fine);
        }
        fine.hold(handles);
        binding = std::make_shared<NodeBinding>();
        binding->places = fine.graph.points;
        effort.nodes = fine.graph.points.size();
        return result;
    }

    /// @return what each point of the graph follows of the level that stands for it
    static std::vector<VertexNodes> followClusters(const SurfaceGraph& graph, std::size_t count,
                                                   Level& level) {
        Clusters clusters = clusterSurface(graph, count);
        std::vector<VertexNodes> result;
        for (std::size_t i = 0; i < graph.points.size(); ++i) {
            result.push_back(
                follow(graph.points[i], nearestAround(clusters.graph, clusters.clusterOf[i],
                                                      graph.points[i], kVertexNodes)));
        }
        level.graph = std::move(clusters.graph);
        return result;
    }

    void addCoarse(const std::vector<PlacedHandle>& handles) {
        if (fine.graph.points.size() < 4 * kCoarseNodes) {
            return;
        }
        coarse.emplace();
        fineFromCoarse = followClusters(fine.graph, kCoarseNodes, *coarse);
        try {
            coarse->hold(handles);
        } catch (const InputError&) { // two handles within one of its few points: without a guess
            coarse.reset();
            return;
        }
        coarseBinding = std::make_shared<NodeBinding>();
        coarseBinding->places = coarse->graph.points;
    }

    void bindVertices(const World& rest, const WeldedWorld& world,
                      const std::vector<std::uint32_t>& component, const Part& part,
                      const std::vector<VertexNodes>& ofPart) {
        std::vector<std::uint32_t> carrierOf(component.size(), kNone); // of components without
        std::vector<VertexNodes> ofPoint(component.size());
        for (std::size_t i = 0; i < component.size(); ++i) {
            if (part.numberOf[i] != kNone) {
                ofPoint[i] = ofPart[part.numberOf[i]];
                continue;
            }
            std::uint32_t& carrier = carrierOf[component[i]];
            if (carrier == kNone) {
                carrier = nearest(binding->places, world.graph.points[i]);
            }
            ofPoint[i] = follow(world.graph.points[i], std::span(&carrier, 1));
        }
        for (std::size_t m = 0; m < rest.meshes.size(); ++m) {
            const Mesh& mesh = rest.meshes[m].mesh;
            std::vector<VertexNodes>& vertices = binding->vertices.emplace_back();
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                const std::uint32_t point = world.pointOf[m][i];
                vertices.push_back(point == kNone ? VertexNodes() : ofPoint[point]);
                vertices.back().at = mesh.positions[i];
            }
            binding->restPoses.push_back(mesh.binding ? meshPose(*rest.rig, *mesh.binding,
                                                                 restPose(*rest.rig),
                                                                 rest.millimetersPerUnit)
                                                      : MeshPose());
        }
    }

    /// A few points settle first and carry the nodes to where their own search begins.
    void start(const std::vector<PlacedHandle>& handles, double still) {
        fine.setTargets(handles);
        if (!coarse) {
            fine.solver->startFromHeld();
            return;
        }
        coarse->setTargets(handles);
        coarse->solver->startFromHeld();
        coarse->solver->settle(still, kMostIterations);
        const NodePose pose{coarseBinding, coarse->solver->nodes()};
        std::vector<MovedNode> guess;
        for (const VertexNodes& node : fineFromCoarse) {
            const Mapped mapped = followNodes(node, pose);
            guess.push_back({mapped.position, mapped.jacobian});
        }
        fine.solver->start(guess);
        fine.setTargets(handles);
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
    s.effort.iterations = s.fine.solver->settle(still, kMostIterations);
    s.effort.msPerIteration = milliseconds(guessed) / s.effort.iterations;
    s.solved = std::make_shared<const NodePose>(NodePose{s.binding, s.fine.solver->nodes()});
    s.solvedHandles = handles;
    s.solvedTo = settling;
    s.effort.ms = milliseconds(start);
    return s.solved;
}

} // namespace celadon
