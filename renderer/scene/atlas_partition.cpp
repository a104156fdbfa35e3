#include "renderer/scene/atlas_partition.h"

#include "renderer/scene/atlas_merge.h"
#include "renderer/scene/atlas_segment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::atlas {
namespace {

/// Of the square root of all area.
constexpr double kNormalSmoothing = 0.012;
constexpr double kSeedReach = 0.13;

constexpr FlattenLimits kSplitLimits{{1.12, 1.30, 2.2}, 6};

using TriangleSets = std::vector<std::vector<int>>;

TriangleSets setsByLabel(const std::vector<int>& labels, const std::vector<int>& triangles) {
    TriangleSets sets(labels.empty() ? 0 : 1 + *std::max_element(labels.begin(), labels.end()));
    for (std::size_t i = 0; i < labels.size(); ++i) {
        sets[labels[i]].push_back(triangles[i]);
    }
    return sets;
}

struct Outcome {
    std::optional<Chart> chart;
    TriangleSets parts; ///< if it did not flatten
};

Outcome flattenOrSplit(const Surface& surface, const DualGraph& graph,
                       const std::vector<int>& triangles) {
    ChartMesh mesh = buildChartMesh(surface, triangles);
    Outcome outcome;
    outcome.chart = flattenChart(surface, mesh, kSplitLimits);
    if (!outcome.chart) {
        outcome.parts = setsByLabel(bisect(restrictTo(graph, mesh)), triangles);
    }
    return outcome;
}

} // namespace

std::vector<Chart> partition(const Surface& surface) {
    const double extent = std::sqrt(surface.totalArea);
    const DualGraph graph = buildDualGraph(surface, kNormalSmoothing * extent);
    std::vector<int> all(surface.triangleCount());
    for (int t = 0; t < surface.triangleCount(); ++t) {
        all[t] = t;
    }
    TriangleSets pending = setsByLabel(segment(graph, kSeedReach * extent), all);
    std::vector<Chart> charts;
    while (!pending.empty()) {
        std::vector<Outcome> outcomes(pending.size());
        tbb::parallel_for(std::size_t{0}, pending.size(), [&](std::size_t i) {
            outcomes[i] = flattenOrSplit(surface, graph, pending[i]);
        });
        pending.clear();
        for (Outcome& outcome : outcomes) {
            if (outcome.chart) {
                charts.push_back(std::move(*outcome.chart));
            }
            for (std::vector<int>& part : outcome.parts) {
                pending.push_back(std::move(part));
            }
        }
    }
    mergeCharts(surface, charts);
    tbb::parallel_for(std::size_t{0}, charts.size(),
                      [&](std::size_t i) { polishChart(surface, charts[i]); });
    std::sort(charts.begin(), charts.end(), [](const Chart& a, const Chart& b) {
        return a.mesh.triangles.front() < b.mesh.triangles.front();
    });
    return charts;
}

} // namespace celadon::atlas
