#include "renderer/scene/surface_graph.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace celadon {

namespace {

using Edge = std::array<std::uint32_t, 2>;
constexpr std::uint32_t kNone = ~0u;
constexpr double kFar = std::numeric_limits<double>::infinity();

double areaOf(const SurfaceGraph& graph) {
    double area = 0.0;
    for (const Triangle& t : graph.triangles) {
        area += 0.5 * glm::length(glm::cross(graph.points[t[1]] - graph.points[t[0]],
                                             graph.points[t[2]] - graph.points[t[0]]));
    }
    return area;
}

/// Dijkstra's walk along the edges, up to a distance.
/// @param distance infinite for all points; afterwards for those that were not reached
/// @param step called for each edge that brings a point nearer, with its ends
template<typename Step>
void walk(const SurfaceGraph& graph, std::span<const std::uint32_t> sources, double farthest,
          std::vector<double>& distance, const Step& step) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const std::uint32_t source : sources) {
        distance[source] = 0.0;
        queue.emplace(0.0, source);
    }
    while (!queue.empty()) {
        const auto [d, at] = queue.top();
        queue.pop();
        if (d > distance[at]) {
            continue;
        }
        for (const std::uint32_t next : graph.neighborsOf(at)) {
            const double further = d + glm::length(graph.points[next] - graph.points[at]);
            if (further <= farthest && further < distance[next]) {
                distance[next] = further;
                step(at, next);
                queue.emplace(further, next);
            }
        }
    }
}

/// Points at least `spacing` apart along the edges, and no point farther than that from all of
/// them.
std::vector<std::uint32_t> spreadPoints(const SurfaceGraph& graph, double spacing) {
    std::vector<std::uint32_t> chosen;
    std::vector<bool> isCovered(graph.points.size(), false);
    std::vector<double> distance(graph.points.size(), kFar);
    std::vector<std::uint32_t> reached;
    for (std::uint32_t i = 0; i < graph.points.size(); ++i) {
        if (isCovered[i]) {
            continue;
        }
        chosen.push_back(i);
        reached.assign(1, i);
        walk(graph, std::span(&i, 1), spacing, distance,
             [&](std::uint32_t, std::uint32_t to) { reached.push_back(to); });
        for (const std::uint32_t at : reached) {
            isCovered[at] = true;
            distance[at] = kFar;
        }
    }
    return chosen;
}

} // namespace

SurfaceGraph makeGraph(std::vector<glm::dvec3> points, std::vector<Triangle> triangles,
                       std::span<const Edge> edges) {
    SurfaceGraph graph;
    graph.points = std::move(points);
    graph.triangles = std::move(triangles);
    std::vector<Edge> directed;
    directed.reserve(2 * edges.size());
    for (const auto& [a, b] : edges) {
        directed.push_back({a, b});
        directed.push_back({b, a});
    }
    std::sort(directed.begin(), directed.end());
    directed.erase(std::unique(directed.begin(), directed.end()), directed.end());
    graph.starts.assign(graph.points.size() + 1, 0);
    graph.neighbors.reserve(directed.size());
    for (const auto& [a, b] : directed) {
        ++graph.starts[a + 1];
        graph.neighbors.push_back(b);
    }
    std::partial_sum(graph.starts.begin(), graph.starts.end(), graph.starts.begin());
    return graph;
}

SurfaceGraph makeGraph(std::vector<glm::dvec3> points, std::vector<Triangle> triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.push_back({t[k], t[(k + 1) % 3]});
        }
    }
    return makeGraph(std::move(points), std::move(triangles), edges);
}

std::vector<std::uint32_t> components(const SurfaceGraph& graph) {
    std::vector<std::uint32_t> result(graph.points.size(), kNone);
    std::vector<std::uint32_t> open;
    std::uint32_t count = 0;
    for (std::uint32_t first = 0; first < result.size(); ++first) {
        if (result[first] != kNone) {
            continue;
        }
        result[first] = count;
        open.push_back(first);
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            for (const std::uint32_t next : graph.neighborsOf(at)) {
                if (result[next] == kNone) {
                    result[next] = count;
                    open.push_back(next);
                }
            }
        }
        ++count;
    }
    return result;
}

Clusters clusterSurface(const SurfaceGraph& graph, std::size_t count) {
    // Points that are at least s apart and cover all within s have, as measured, about s^2 each.
    const double spacing = std::sqrt(areaOf(graph) / static_cast<double>(count));
    Clusters result;
    result.chosen = spreadPoints(graph, spacing);
    result.clusterOf.assign(graph.points.size(), kNone);
    std::vector<double> distance(graph.points.size(), kFar);
    for (std::uint32_t c = 0; c < result.chosen.size(); ++c) {
        result.clusterOf[result.chosen[c]] = c;
    }
    walk(graph, result.chosen, kFar, distance, [&](std::uint32_t from, std::uint32_t to) {
        result.clusterOf[to] = result.clusterOf[from];
    });
    std::vector<glm::dvec3> points;
    for (const std::uint32_t point : result.chosen) {
        points.push_back(graph.points[point]);
    }
    std::vector<Edge> edges;
    for (std::uint32_t a = 0; a < graph.points.size(); ++a) {
        for (const std::uint32_t b : graph.neighborsOf(a)) {
            if (result.clusterOf[a] < result.clusterOf[b]) {
                edges.push_back({result.clusterOf[a], result.clusterOf[b]});
            }
        }
    }
    std::vector<Triangle> triangles;
    for (const Triangle& t : graph.triangles) {
        Triangle dual{result.clusterOf[t[0]], result.clusterOf[t[1]], result.clusterOf[t[2]]};
        if (dual[0] != dual[1] && dual[1] != dual[2] && dual[2] != dual[0]) {
            std::rotate(dual.begin(), std::min_element(dual.begin(), dual.end()), dual.end());
            triangles.push_back(dual);
        }
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    result.graph = makeGraph(std::move(points), std::move(triangles), edges);
    return result;
}

std::vector<std::uint32_t> nearestAround(const SurfaceGraph& graph, std::uint32_t around,
                                         const glm::dvec3& p, std::size_t most) {
    std::vector<std::uint32_t> near{around};
    for (const std::uint32_t next : graph.neighborsOf(around)) {
        near.push_back(next);
        for (const std::uint32_t second : graph.neighborsOf(next)) {
            near.push_back(second);
        }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    const auto isNearer = [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec3 toA = graph.points[a] - p;
        const glm::dvec3 toB = graph.points[b] - p;
        return std::pair(glm::dot(toA, toA), a) < std::pair(glm::dot(toB, toB), b);
    };
    const std::size_t count = std::min(near.size(), most);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end(),
                      isNearer);
    near.resize(count);
    return near;
}

} // namespace celadon
