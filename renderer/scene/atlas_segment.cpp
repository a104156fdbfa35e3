#include "renderer/scene/atlas_segment.h"

#include "renderer/scene/atlas_smooth_borders.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace celadon::atlas {
namespace {

/// What a step costs on a plane, relative to one at right angles to the region's mean normal.
constexpr double kFlatCost = 0.15;
/// What crossing a crease adds, so that borders like to lie there.
constexpr double kCreaseCost = 0.5;
constexpr int kLloydIterations = 6;
/// Against seeds without end on surfaces that are rough at every scale.
constexpr std::size_t kMaxExtraSeeds = 256;

struct Growth {
    std::vector<double> cost;
    std::vector<int> label;

    explicit Growth(int nodes)
        : cost(nodes, std::numeric_limits<double>::infinity()), label(nodes, -1) {}
};

struct Seed {
    int node;
    Eigen::Vector3d axis;
};

/// Dijkstra from the seeds from `firstNew` on; nodes change hands where the new path is shorter.
void grow(const DualGraph& graph, const std::vector<Seed>& seeds, std::size_t firstNew,
          Growth& growth) {
    using Entry = std::tuple<double, int, int>; // cost, node, label
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](int node, int label, double cost) {
        if (cost < growth.cost[node]) {
            growth.cost[node] = cost;
            growth.label[node] = label;
            queue.emplace(cost, node, label);
        }
    };
    for (std::size_t s = firstNew; s < seeds.size(); ++s) {
        offer(seeds[s].node, static_cast<int>(s), 0.0);
    }
    while (!queue.empty()) {
        const auto [cost, node, label] = queue.top();
        queue.pop();
        if (cost > growth.cost[node] || label != growth.label[node]) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const int n = graph.neighbors[3 * node + k];
            if (n < 0) {
                continue;
            }
            const double turn = 1.0 - seeds[label].axis.dot(graph.normals[n]);
            const double crease = 1.0 - graph.normals[node].dot(graph.normals[n]);
            const double step = (graph.centers[n] - graph.centers[node]).norm();
            offer(n, label, cost + step * (kFlatCost + turn + kCreaseCost * crease));
        }
    }
}

int farthest(const Growth& growth) {
    return static_cast<int>(std::max_element(growth.cost.begin(), growth.cost.end()) -
                            growth.cost.begin());
}

/// Seeds to the node nearest to the region's center of area, axes to the mean normals.
void recenter(const DualGraph& graph, const Growth& growth, std::vector<Seed>& seeds) {
    std::vector<Eigen::Vector3d> center(seeds.size(), Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> axis(seeds.size(), Eigen::Vector3d::Zero());
    std::vector<double> area(seeds.size(), 0.0);
    for (int t = 0; t < graph.size(); ++t) {
        const int label = growth.label[t];
        center[label] += graph.areas[t] * graph.centers[t];
        axis[label] += graph.areas[t] * graph.normals[t];
        area[label] += graph.areas[t];
    }
    std::vector<double> nearest(seeds.size(), std::numeric_limits<double>::infinity());
    for (int t = 0; t < graph.size(); ++t) {
        const int label = growth.label[t];
        if (!(area[label] > 0.0)) {
            continue;
        }
        const double distance = (graph.centers[t] - center[label] / area[label]).squaredNorm();
        if (distance < nearest[label]) {
            nearest[label] = distance;
            seeds[label].node = t;
        }
    }
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        seeds[s].axis = axis[s].normalized();
    }
}

std::vector<int> lloyd(const DualGraph& graph, std::vector<Seed> seeds, Growth growth) {
    for (int iteration = 0; iteration < kLloydIterations; ++iteration) {
        std::vector<int> before(seeds.size());
        std::transform(seeds.begin(), seeds.end(), before.begin(),
                       [](const Seed& seed) { return seed.node; });
        recenter(graph, growth, seeds);
        Growth fresh(graph.size());
        grow(graph, seeds, 0, fresh);
        growth = std::move(fresh);
        if (std::equal(seeds.begin(), seeds.end(), before.begin(),
                       [](const Seed& seed, int node) { return seed.node == node; }) &&
            iteration > 0) {
            break;
        }
    }
    return growth.label;
}

Seed seedAt(const DualGraph& graph, int node) {
    return {node, graph.normals[node]};
}

} // namespace

std::vector<int> segment(const DualGraph& graph, double reach) {
    // One seed for every connected part: where it is farthest from its first triangle, which
    // depends less on the order of triangles than the first triangle itself.
    const std::vector<int> parts = connectedParts(graph, std::vector<int>(graph.size(), 0));
    std::vector<Seed> seeds;
    for (int t = 0; t < graph.size(); ++t) {
        if (parts[t] == static_cast<int>(seeds.size())) {
            seeds.push_back(seedAt(graph, t));
        }
    }
    Growth first(graph.size());
    grow(graph, seeds, 0, first);
    std::vector<int> ends(seeds.size(), -1);
    for (int t = 0; t < graph.size(); ++t) {
        int& end = ends[parts[t]];
        end = end < 0 || first.cost[t] > first.cost[end] ? t : end;
    }
    for (std::size_t s = 0; s < seeds.size(); ++s) {
        seeds[s] = seedAt(graph, ends[s]);
    }
    Growth growth(graph.size());
    grow(graph, seeds, 0, growth);
    const std::size_t mostSeeds = seeds.size() + kMaxExtraSeeds;
    while (seeds.size() < mostSeeds) {
        const int node = farthest(growth);
        if (growth.cost[node] <= reach) {
            break;
        }
        seeds.push_back(seedAt(graph, node));
        grow(graph, seeds, seeds.size() - 1, growth);
    }
    std::vector<int> labels = lloyd(graph, std::move(seeds), std::move(growth));
    smoothBorders(graph, labels);
    return connectedParts(graph, labels);
}

std::vector<int> bisect(const DualGraph& graph) {
    std::vector<Seed> seeds = {seedAt(graph, 0)};
    for (int sweep = 0; sweep < 2; ++sweep) {
        Growth growth(graph.size());
        grow(graph, seeds, 0, growth);
        seeds[0] = seedAt(graph, farthest(growth));
    }
    Growth growth(graph.size());
    grow(graph, seeds, 0, growth);
    seeds.push_back(seedAt(graph, farthest(growth)));
    grow(graph, seeds, 1, growth);
    std::vector<int> labels = lloyd(graph, seeds, growth);
    std::vector<int> smooth = labels;
    smoothBorders(graph, smooth);
    if (std::adjacent_find(smooth.begin(), smooth.end(), std::not_equal_to<>()) != smooth.end()) {
        labels = std::move(smooth);
    } else if (std::adjacent_find(labels.begin(), labels.end(), std::not_equal_to<>()) ==
                   labels.end() &&
               labels.size() > 1) {
        labels[0] = labels[0] + 1; // all in one place: any division is as good
    }
    return connectedParts(graph, labels);
}

} // namespace celadon::atlas
