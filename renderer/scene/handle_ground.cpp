#include "renderer/scene/handle_ground.h"

#include "renderer/scene/weld_vertices.h"
#include "subedit/errors.h"
#include "subedit/stop_point.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace celadon {

namespace {

constexpr std::size_t kCoarseNodes = 500;
constexpr std::uint32_t kNone = WeldedWorld::kNone;

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
    subedit::stopPoint();
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
    subedit::stopPoint();
    WeldedWorld result;
    result.graph = makeGraph(std::move(points), std::move(triangles));
    result.component = components(result.graph);
    for (const std::uint32_t component : result.component) {
        result.components = std::max(result.components, component + 1);
    }
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

VertexNodes follow(const glm::dvec3& p, std::span<const std::uint32_t> nodes) {
    VertexNodes result;
    result.at = glm::vec3(p);
    std::copy(nodes.begin(), nodes.end(), result.nodes.begin());
    return result;
}

/// Points in place of a graph's, about so many.
struct Proxy {
    SurfaceGraph graph;
    std::vector<VertexNodes> nodes; ///< what each point of the graph follows
};

Proxy proxyOf(const SurfaceGraph& graph, std::size_t count) {
    Clusters clusters = clusterSurface(graph, count);
    subedit::stopPoint();
    Proxy result;
    result.nodes.reserve(graph.points.size());
    for (std::size_t i = 0; i < graph.points.size(); ++i) {
        result.nodes.push_back(
            follow(graph.points[i], nearestAround(clusters.graph, clusters.clusterOf[i],
                                                  graph.points[i], kVertexNodes)));
    }
    result.graph = std::move(clusters.graph);
    return result;
}

/// Each point its own node.
std::vector<VertexNodes> ownNodes(const SurfaceGraph& graph) {
    std::vector<VertexNodes> result;
    for (std::uint32_t i = 0; i < graph.points.size(); ++i) {
        result.push_back(follow(graph.points[i], std::span(&i, 1)));
    }
    return result;
}

/// What each vertex follows: of components without handles, the node that is nearest to it.
std::shared_ptr<const NodeBinding> bindVertices(const World& rest, const WeldedWorld& world,
                                                const SurfaceGraph& nodes,
                                                const std::vector<std::uint32_t>& numberInPart,
                                                const std::vector<VertexNodes>& ofPart) {
    auto binding = std::make_shared<NodeBinding>();
    binding->places = nodes.points;
    std::vector<std::uint32_t> carrierOf(world.components, kNone);
    std::vector<VertexNodes> ofPoint(world.component.size());
    for (std::size_t i = 0; i < world.component.size(); ++i) {
        if (numberInPart[i] != kNone) {
            ofPoint[i] = ofPart[numberInPart[i]];
            continue;
        }
        std::uint32_t& carrier = carrierOf[world.component[i]];
        if (carrier == kNone) {
            carrier = nearestPoint(binding->places, world.graph.points[i]);
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
        binding->restPoses.push_back(
            mesh.binding
                ? meshPose(*rest.rig, *mesh.binding, restPose(*rest.rig), rest.millimetersPerUnit)
                : MeshPose());
    }
    return binding;
}

GroundNodes makeNodes(const World& rest, const WeldedWorld& world, std::vector<bool> hasHandle) {
    Part part = partOf(world.graph, [&](std::uint32_t i) { return hasHandle[world.component[i]]; });
    subedit::stopPoint();
    GroundNodes result;
    result.hasHandle = std::move(hasHandle);
    std::vector<VertexNodes> ofPart;
    if (part.graph.points.size() <= kMostNodes) {
        ofPart = ownNodes(part.graph);
        result.graph = std::move(part.graph);
    } else {
        Proxy proxy = proxyOf(part.graph, kClusterNodes);
        ofPart = std::move(proxy.nodes);
        result.graph = std::move(proxy.graph);
    }
    result.binding = bindVertices(rest, world, result.graph, part.numberOf, ofPart);
    if (result.graph.points.size() >= 4 * kCoarseNodes) {
        Proxy few = proxyOf(result.graph, kCoarseNodes);
        auto binding = std::make_shared<NodeBinding>();
        binding->places = few.graph.points;
        result.coarse = {std::move(few.graph), std::move(few.nodes), std::move(binding)};
    }
    return result;
}

} // namespace

std::uint32_t nearestPoint(std::span<const glm::dvec3> points, const glm::dvec3& p) {
    const auto closer = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
    };
    return static_cast<std::uint32_t>(std::min_element(points.begin(), points.end(), closer) -
                                      points.begin());
}

std::shared_ptr<const WeldedWorld> HandleGround::surface(const World& rest) {
    const std::lock_guard lock(mMutex);
    if (!mSurface) {
        auto surface = std::make_shared<const WeldedWorld>(weld(rest));
        if (surface->graph.points.empty()) {
            throw InputError("the handles", "there is no triangle that has an area to hold",
                             "check the model");
        }
        mSurface = std::move(surface);
    }
    return mSurface;
}

std::shared_ptr<const GroundNodes> HandleGround::nodes(const World& rest,
                                                       const std::vector<PlacedHandle>& handles) {
    const std::shared_ptr<const WeldedWorld> world = surface(rest);
    std::vector<bool> hasHandle(world->components, false);
    for (const PlacedHandle& handle : handles) {
        hasHandle[world->component[nearestPoint(world->graph.points, handle.at)]] = true;
    }
    const std::lock_guard lock(mMutex);
    if (!mNodes || mNodes->hasHandle != hasHandle) {
        mNodes = std::make_shared<const GroundNodes>(makeNodes(rest, *world, std::move(hasHandle)));
    }
    return mNodes;
}

} // namespace celadon
