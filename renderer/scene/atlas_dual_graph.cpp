#include "renderer/scene/atlas_dual_graph.h"

#include "renderer/scene/atlas_union_find.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::atlas {
namespace {

constexpr int kMaxSmoothing = 40;

/// Each sweep spreads a normal by about an edge; n of them by about sqrt(n) edges.
void smoothNormals(DualGraph& graph, double radius, double totalArea) {
    const double edge = std::sqrt(2.3 * totalArea / graph.size());
    const double sweeps = radius * radius / (edge * edge);
    const int count = static_cast<int>(std::min<double>(kMaxSmoothing, sweeps));
    std::vector<Eigen::Vector3d> next(graph.normals.size());
    for (int sweep = 0; sweep < count; ++sweep) {
        tbb::parallel_for(tbb::blocked_range<int>(0, graph.size(), 4096), [&](const auto& range) {
            for (int t = range.begin(); t < range.end(); ++t) {
                Eigen::Vector3d sum = graph.areas[t] * graph.normals[t];
                double weight = graph.areas[t];
                for (int k = 0; k < 3; ++k) {
                    const int n = graph.neighbors[3 * t + k];
                    if (n >= 0) {
                        sum += graph.areas[n] * graph.normals[n];
                        weight += graph.areas[n];
                    }
                }
                next[t] = weight > 0.0 ? Eigen::Vector3d(sum / weight) : graph.normals[t];
            }
        });
        graph.normals.swap(next);
    }
    if (count > 0) {
        for (Eigen::Vector3d& n : graph.normals) {
            n.normalize(); // zero stays zero
        }
    }
}

} // namespace

DualGraph buildDualGraph(const Surface& surface, double smoothingRadius) {
    DualGraph graph;
    const int count = surface.triangleCount();
    graph.areas = surface.areas;
    graph.faceNormals = surface.normals;
    graph.normals = surface.normals;
    graph.neighbors.resize(3 * static_cast<std::size_t>(count));
    graph.edgeLengths.resize(graph.neighbors.size());
    graph.centers.resize(count);
    for (int t = 0; t < count; ++t) {
        const std::array<int, 3>& v = surface.triangles[t];
        graph.centers[t] =
            (surface.positions[v[0]] + surface.positions[v[1]] + surface.positions[v[2]]) / 3.0;
        for (int k = 0; k < 3; ++k) {
            const int twin = surface.twins[3 * t + k];
            graph.neighbors[3 * t + k] = twin < 0 ? -1 : twin / 3;
            graph.edgeLengths[3 * t + k] =
                (surface.positions[v[(k + 1) % 3]] - surface.positions[v[k]]).norm();
        }
    }
    smoothNormals(graph, smoothingRadius, surface.totalArea);
    return graph;
}

DualGraph restrictTo(const DualGraph& graph, const ChartMesh& mesh) {
    DualGraph part;
    const std::size_t count = mesh.triangles.size();
    part.neighbors.resize(3 * count);
    part.edgeLengths.resize(3 * count);
    part.centers.resize(count);
    part.normals.resize(count);
    part.faceNormals.resize(count);
    part.areas.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const int t = mesh.triangles[i];
        part.centers[i] = graph.centers[t];
        part.normals[i] = graph.normals[t];
        part.faceNormals[i] = graph.faceNormals[t];
        part.areas[i] = graph.areas[t];
        for (int k = 0; k < 3; ++k) {
            const int twin = mesh.twins[3 * i + k];
            part.neighbors[3 * i + k] = twin < 0 ? -1 : twin / 3;
            part.edgeLengths[3 * i + k] = graph.edgeLengths[3 * t + k];
        }
    }
    return part;
}

std::vector<int> connectedParts(const DualGraph& graph, std::span<const int> labels) {
    UnionFind sets(graph.size());
    for (int t = 0; t < graph.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int n = graph.neighbors[3 * t + k];
            if (n > t && labels[n] == labels[t]) {
                sets.unite(t, n);
            }
        }
    }
    std::vector<int> number(graph.size(), -1);
    std::vector<int> parts(graph.size());
    int count = 0;
    for (int t = 0; t < graph.size(); ++t) {
        int& part = number[sets.find(t)];
        if (part < 0) {
            part = count++;
        }
        parts[t] = part;
    }
    return parts;
}

} // namespace celadon::atlas
