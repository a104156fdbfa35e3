#include "renderer/scene/atlas_surface.h"

#include "renderer/scene/atlas_union_find.h"
#include "subedit/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_map>

namespace celadon::atlas {
namespace {

/// A connected part smaller than this, relative to all area, would be smaller in the map than a
/// float can tell from a point.
constexpr double kNegligibleArea = 1e-14;
/// Edges with more triangles than this belong to no sensible surface; they become borders.
constexpr std::size_t kMaxEdgeFan = 32;

struct PositionHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
        std::uint64_t h = bits[0];
        h = (h ^ (h >> 15)) * 0x9E3779B97F4A7C15ull + bits[1];
        h = (h ^ (h >> 29)) * 0xBF58476D1CE4E5B9ull + bits[2];
        h = (h ^ (h >> 32)) * 0x94D049BB133111EBull;
        return static_cast<std::size_t>(h ^ (h >> 31));
    }
};

std::string meshName(const Mesh& mesh, std::size_t number) {
    return mesh.name.empty() ? "mesh " + std::to_string(number) : "mesh '" + mesh.name + "'";
}

void weldPositions(std::span<const Mesh* const> meshes, Surface& surface) {
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Mesh& mesh = *meshes[m];
        std::unordered_map<std::array<std::uint32_t, 3>, int, PositionHash> index;
        index.reserve(mesh.positions.size());
        std::vector<int>& welded = surface.welded.emplace_back(mesh.positions.size(), -1);
        for (const std::uint32_t v : mesh.indices) {
            if (welded[v] >= 0) {
                continue;
            }
            const glm::vec3 p = mesh.positions[v] + 0.0f; // -0 becomes +0
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                throw InputError(meshName(mesh, m),
                                 "vertex " + std::to_string(v) + " is not at a finite position",
                                 "repair the mesh and export it again");
            }
            const auto [place, isNew] = index.try_emplace(
                {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                 std::bit_cast<std::uint32_t>(p.z)},
                static_cast<int>(surface.positions.size()));
            if (isNew) {
                surface.positions.emplace_back(p.x, p.y, p.z);
            }
            welded[v] = place->second;
        }
    }
}

/// Huge and tiny coordinates alike are brought to order one, where squares neither overflow nor
/// vanish.
void normalizePositions(Surface& surface) {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = -low;
    for (const Eigen::Vector3d& p : surface.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double diagonal = (high - low).stableNorm();
    const Eigen::Vector3d center = 0.5 * (low + high);
    const double scale = diagonal > 0.0 ? diagonal : 1.0;
    for (Eigen::Vector3d& p : surface.positions) {
        p = (p - center) / scale;
    }
}

void collectTriangles(std::span<const Mesh* const> meshes, Surface& surface) {
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Mesh& mesh = *meshes[m];
        double meshArea = 0.0;
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const SourceTriangle source{static_cast<int>(m), static_cast<int>(t)};
            const std::array<int, 3> v = {surface.welded[m][mesh.indices[3 * t]],
                                          surface.welded[m][mesh.indices[3 * t + 1]],
                                          surface.welded[m][mesh.indices[3 * t + 2]]};
            if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
                surface.dropped.push_back(source);
                continue;
            }
            const Eigen::Vector3d& a = surface.positions[v[0]];
            const Eigen::Vector3d cross =
                (surface.positions[v[1]] - a).cross(surface.positions[v[2]] - a);
            const double norm = cross.stableNorm();
            surface.triangles.push_back(v);
            surface.areas.push_back(0.5 * norm);
            surface.normals.push_back(norm > 0.0 ? Eigen::Vector3d(cross / norm)
                                                 : Eigen::Vector3d::Zero());
            surface.sources.push_back(source);
            meshArea += 0.5 * norm;
        }
        if (!(meshArea > 0.0)) {
            throw InputError(meshName(mesh, m), "no triangle has an area",
                             "remove the mesh, or give it texture coordinates");
        }
        surface.totalArea += meshArea;
    }
}

struct EdgeEntry {
    std::uint64_t key; ///< smaller vertex, larger vertex
    int halfEdge;
    bool operator<(const EdgeEntry& other) const {
        return key != other.key ? key < other.key : halfEdge < other.halfEdge;
    }
};

/// How well two half-edges continue each other: those that the file itself joins by index come
/// first, then the flattest. Sheets back to back thus stay apart.
double continuation(const Surface& surface, std::span<const Mesh* const> meshes, int a, int b) {
    const auto sourceVertex = [&](int halfEdge, int corner) {
        const SourceTriangle& s = surface.sources[halfEdge / 3];
        return meshes[s.mesh]->indices[3 * s.triangle + (halfEdge % 3 + corner) % 3];
    };
    const bool sameIndices =
        sourceVertex(a, 0) == sourceVertex(b, 1) && sourceVertex(a, 1) == sourceVertex(b, 0);
    return surface.normals[a / 3].dot(surface.normals[b / 3]) + (sameIndices ? 4.0 : 0.0);
}

void pairFan(Surface& surface, std::span<const Mesh* const> meshes,
             std::span<const EdgeEntry> fan) {
    struct Pair {
        double score;
        int a, b;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < fan.size(); ++i) {
        for (std::size_t j = i + 1; j < fan.size(); ++j) {
            const int a = fan[i].halfEdge;
            const int b = fan[j].halfEdge;
            const bool opposite =
                surface.triangles[a / 3][a % 3] != surface.triangles[b / 3][b % 3];
            if (opposite && a / 3 != b / 3) {
                pairs.push_back({continuation(surface, meshes, a, b), a, b});
            }
        }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.score > y.score; });
    for (const Pair& pair : pairs) {
        if (surface.twins[pair.a] < 0 && surface.twins[pair.b] < 0) {
            surface.twins[pair.a] = pair.b;
            surface.twins[pair.b] = pair.a;
        }
    }
}

void pairHalfEdges(std::span<const Mesh* const> meshes, Surface& surface) {
    std::vector<EdgeEntry> edges(surface.triangles.size() * 3);
    for (std::size_t h = 0; h < edges.size(); ++h) {
        const auto a = static_cast<std::uint64_t>(surface.triangles[h / 3][h % 3]);
        const auto b = static_cast<std::uint64_t>(surface.triangles[h / 3][(h % 3 + 1) % 3]);
        edges[h] = {std::min(a, b) << 32 | std::max(a, b), static_cast<int>(h)};
    }
    std::sort(edges.begin(), edges.end());
    surface.twins.assign(edges.size(), -1);
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].key == edges[begin].key) {
            ++end;
        }
        if (end - begin <= kMaxEdgeFan) {
            pairFan(surface, meshes, std::span(edges).subspan(begin, end - begin));
        }
        begin = end;
    }
}

/// A triangle and its own back side close around nothing; joined over their longest edge alone they
/// can be laid flat together.
void openFlaps(Surface& surface) {
    for (int t = 0; t < surface.triangleCount(); ++t) {
        const std::array<int, 3> twins = {surface.twins[3 * t], surface.twins[3 * t + 1],
                                          surface.twins[3 * t + 2]};
        const int other = twins[0] / 3;
        if (twins[0] < 0 || twins[1] < 0 || twins[2] < 0 || twins[1] / 3 != other ||
            twins[2] / 3 != other) {
            continue;
        }
        const auto length = [&](int k) {
            return (surface.positions[surface.triangles[t][(k + 1) % 3]] -
                    surface.positions[surface.triangles[t][k]])
                .squaredNorm();
        };
        const int longest = length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2)
                                                   : (length(1) >= length(2) ? 1 : 2);
        for (int k = 0; k < 3; ++k) {
            if (k != longest) {
                surface.twins[twins[k]] = -1;
                surface.twins[3 * t + k] = -1;
            }
        }
    }
}

/// Parts without area (lines, points) would only cost space in the map.
void dropNegligibleParts(Surface& surface) {
    const int count = surface.triangleCount();
    UnionFind parts(count);
    for (int h = 0; h < 3 * count; ++h) {
        if (surface.twins[h] > h) {
            parts.unite(h / 3, surface.twins[h] / 3);
        }
    }
    std::vector<double> area(count, 0.0);
    for (int t = 0; t < count; ++t) {
        area[parts.find(t)] += surface.areas[t];
    }
    std::vector<int> renumbered(count, -1);
    int kept = 0;
    for (int t = 0; t < count; ++t) {
        if (area[parts.find(t)] > kNegligibleArea * surface.totalArea) {
            renumbered[t] = kept++;
        } else {
            surface.dropped.push_back(surface.sources[t]);
        }
    }
    if (kept == count) {
        return;
    }
    std::vector<int> twins(3 * static_cast<std::size_t>(kept), -1);
    for (int t = 0; t < count; ++t) {
        const int to = renumbered[t];
        if (to < 0) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const int twin = surface.twins[3 * t + k];
            twins[3 * to + k] = twin < 0 ? -1 : 3 * renumbered[twin / 3] + twin % 3;
        }
        surface.triangles[to] = surface.triangles[t];
        surface.normals[to] = surface.normals[t];
        surface.areas[to] = surface.areas[t];
        surface.sources[to] = surface.sources[t];
    }
    surface.twins = std::move(twins);
    surface.triangles.resize(kept);
    surface.normals.resize(kept);
    surface.areas.resize(kept);
    surface.sources.resize(kept);
}

} // namespace

Surface buildSurface(std::span<const Mesh* const> meshes) {
    Surface surface;
    weldPositions(meshes, surface);
    normalizePositions(surface);
    collectTriangles(meshes, surface);
    pairHalfEdges(meshes, surface);
    openFlaps(surface);
    dropNegligibleParts(surface);
    return surface;
}

} // namespace celadon::atlas
