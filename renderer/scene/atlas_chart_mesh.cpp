#include "renderer/scene/atlas_chart_mesh.h"

#include "renderer/scene/atlas_union_find.h"
#include "subedit/assert.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

namespace celadon::atlas {
namespace {

int next(int halfEdge) {
    return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1;
}

/// Local twins by binary search: the triangle list is ascending.
void findTwins(const Surface& surface, ChartMesh& mesh) {
    const std::vector<int>& triangles = mesh.triangles;
    mesh.twins.assign(3 * triangles.size(), -1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const int twin = surface.twins[3 * triangles[t] + k];
            if (twin < 0) {
                continue;
            }
            const auto found = std::lower_bound(triangles.begin(), triangles.end(), twin / 3);
            if (found != triangles.end() && *found == twin / 3) {
                mesh.twins[3 * t + k] =
                    static_cast<int>(3 * (found - triangles.begin())) + twin % 3;
            }
        }
    }
}

/// Corners around a point are one vertex as far as twins connect them.
void joinCorners(const Surface& surface, ChartMesh& mesh) {
    const int halfEdges = static_cast<int>(mesh.twins.size());
    UnionFind sets(halfEdges);
    for (int h = 0; h < halfEdges; ++h) {
        if (mesh.twins[h] > h) {
            sets.unite(h, next(mesh.twins[h]));
            sets.unite(next(h), mesh.twins[h]);
        }
    }
    mesh.corners.resize(mesh.triangles.size());
    mesh.surfaceVertices.clear();
    std::vector<int> number(halfEdges, -1);
    for (int h = 0; h < halfEdges; ++h) {
        int& vertex = number[sets.find(h)];
        if (vertex < 0) {
            vertex = mesh.vertexCount();
            mesh.surfaceVertices.push_back(surface.triangles[mesh.triangles[h / 3]][h % 3]);
        }
        mesh.corners[h / 3][h % 3] = vertex;
    }
}

void traceLoops(const Surface& surface, ChartMesh& mesh) {
    mesh.loops.clear();
    mesh.loopLengths.clear();
    std::vector<int> following(mesh.vertexCount(), -1); // along the border
    for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
        if (mesh.twins[h] < 0) {
            following[mesh.corners[h / 3][h % 3]] = mesh.corners[next(h) / 3][next(h) % 3];
        }
    }
    std::vector<std::pair<double, std::vector<int>>> loops;
    for (int start = 0; start < mesh.vertexCount(); ++start) {
        if (following[start] < 0) {
            continue;
        }
        std::vector<int> loop;
        double length = 0.0;
        for (int v = start; following[v] >= 0;) {
            loop.push_back(v);
            const int w = following[v];
            following[v] = -1;
            length += (surface.positions[mesh.surfaceVertices[w]] -
                       surface.positions[mesh.surfaceVertices[v]])
                          .norm();
            v = w;
        }
        loops.emplace_back(length, std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [length, loop] : loops) {
        mesh.loops.push_back(std::move(loop));
        mesh.loopLengths.push_back(length);
    }
}

void rebuildVertices(const Surface& surface, ChartMesh& mesh) {
    joinCorners(surface, mesh);
    traceLoops(surface, mesh);
}

/// Shortest path by edges from loop 0 to any other long loop, as local half-edges; paths touch
/// borders at their ends only.
std::vector<int> pathBetweenLoops(const Surface& surface, const ChartMesh& mesh,
                                  std::size_t longLoops) {
    std::vector<int> loopOf(mesh.vertexCount(), -1);
    for (std::size_t i = 0; i < mesh.loops.size(); ++i) {
        for (const int v : mesh.loops[i]) {
            loopOf[v] = static_cast<int>(i);
        }
    }
    std::vector<double> distance(mesh.vertexCount(), std::numeric_limits<double>::infinity());
    std::vector<int> arrivedBy(mesh.vertexCount(), -1);
    // Outgoing half-edges per vertex, and edges seen from their other end.
    std::vector<int> first(mesh.vertexCount() + 1, 0);
    for (const std::array<int, 3>& corner : mesh.corners) {
        for (const int v : corner) {
            ++first[v + 1];
        }
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int> outgoing(mesh.twins.size());
    std::vector<int> fill(first.begin(), first.end() - 1);
    for (int h = 0; h < static_cast<int>(mesh.twins.size()); ++h) {
        outgoing[fill[mesh.corners[h / 3][h % 3]]++] = h;
    }
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int v : mesh.loops[0]) {
        distance[v] = 0.0;
        queue.emplace(0.0, v);
    }
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) {
            continue;
        }
        if (loopOf[v] > 0) {
            if (loopOf[v] >= static_cast<int>(longLoops)) {
                continue; // a small hole: no way through
            }
            std::vector<int> path;
            for (int w = v; arrivedBy[w] >= 0;
                 w = mesh.corners[arrivedBy[w] / 3][arrivedBy[w] % 3]) {
                path.push_back(arrivedBy[w]);
            }
            return path;
        }
        for (int i = first[v]; i < first[v + 1]; ++i) {
            const int h = outgoing[i];
            if (mesh.twins[h] < 0) {
                continue; // along a border
            }
            const int w = mesh.corners[next(h) / 3][next(h) % 3];
            const double along = d + (surface.positions[mesh.surfaceVertices[w]] -
                                      surface.positions[mesh.surfaceVertices[v]])
                                         .norm();
            if (along < distance[w]) {
                distance[w] = along;
                arrivedBy[w] = h;
                queue.emplace(along, w);
            }
        }
    }
    return {};
}

} // namespace

int ChartMesh::eulerCharacteristic() const {
    int borderEdges = 0;
    for (const int twin : twins) {
        borderEdges += twin < 0 ? 1 : 0;
    }
    const int edges = (static_cast<int>(twins.size()) + borderEdges) / 2;
    return vertexCount() - edges + triangleCount();
}

ChartMesh buildChartMesh(const Surface& surface, std::vector<int> triangles) {
    CELADON_ASSERT(std::is_sorted(triangles.begin(), triangles.end()));
    ChartMesh mesh;
    mesh.triangles = std::move(triangles);
    findTwins(surface, mesh);
    rebuildVertices(surface, mesh);
    return mesh;
}

bool cutToDisk(const Surface& surface, ChartMesh& mesh, double shortLoop) {
    bool changed = false;
    for (;;) {
        std::size_t longLoops = 0;
        while (longLoops < mesh.loops.size() &&
               mesh.loopLengths[longLoops] >= shortLoop * mesh.loopLengths[0]) {
            ++longLoops;
        }
        if (longLoops < 2) {
            return changed;
        }
        const std::vector<int> path = pathBetweenLoops(surface, mesh, longLoops);
        if (path.empty()) {
            return changed;
        }
        for (const int h : path) {
            mesh.twins[mesh.twins[h]] = -1;
            mesh.twins[h] = -1;
        }
        rebuildVertices(surface, mesh);
        changed = true;
    }
}

} // namespace celadon::atlas
