#include "renderer/scene/surface_atlas_of_world.h"

#include "subedit/assert.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace celadon {

namespace {

/// Pieces of a mesh that share vertices: the root vertex of each vertex.
std::vector<std::uint32_t> connectedPieces(const Mesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](std::uint32_t v) {
        while (parent[v] != v) {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        return v;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = find(mesh.indices[i]);
        const std::uint32_t b = find(mesh.indices[i + 1]);
        parent[std::max(a, b)] = std::min(a, b);
        const std::uint32_t c = find(mesh.indices[i + 2]);
        const std::uint32_t d = std::min(a, b);
        parent[std::max(c, d)] = std::min(c, d);
    }
    for (std::uint32_t v = 0; v < parent.size(); ++v) {
        parent[v] = find(v);
    }
    return parent;
}

int wrapped(int i, int size) {
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

class AtlasRasterizer {
public:
    AtlasRasterizer(int width, int height) {
        mAtlas.width = width;
        mAtlas.height = height;
        const std::size_t texels =
            static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        mAtlas.positionMm.assign(texels, glm::vec3(0.0f));
        mAtlas.normal.assign(texels, glm::vec3(0.0f, 0.0f, 1.0f));
        mAtlas.chart.assign(texels, -1);
    }

    void add(const Mesh& mesh) {
        const std::vector<std::uint32_t> pieces = connectedPieces(mesh);
        std::vector<std::int32_t> chartOf(pieces.size(), -1);
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            std::int32_t& chart = chartOf[pieces[mesh.indices[i]]];
            if (chart < 0) {
                chart = mCharts++;
            }
            addTriangle(mesh, i, chart);
        }
    }

    [[nodiscard]] subedit::SurfaceAtlas take() { return std::move(mAtlas); }

private:
    /// Every texel whose center lies in the triangle, edges included: what two triangles share goes
    /// to the first.
    void addTriangle(const Mesh& mesh, std::size_t first, std::int32_t chart) {
        std::array<glm::dvec2, 3> p;
        std::array<std::uint32_t, 3> v{};
        for (std::size_t c = 0; c < 3; ++c) {
            v[c] = mesh.indices[first + c];
            p[c] = glm::dvec2(mesh.uvs[v[c]]) * glm::dvec2(mAtlas.width, mAtlas.height) - 0.5;
        }
        const double area = cross(p[1] - p[0], p[2] - p[0]);
        if (!(std::abs(area) > 1e-12) || !std::isfinite(area)) {
            return;
        }
        constexpr double kFarthest = 1e6; // texels: coordinates beyond repeat no picture
        const auto low = glm::max(glm::min(glm::min(p[0], p[1]), p[2]), glm::dvec2(-kFarthest));
        const auto high = glm::min(glm::max(glm::max(p[0], p[1]), p[2]), glm::dvec2(kFarthest));
        constexpr double kEdge = -1e-9;
        const int lastX = static_cast<int>(std::floor(high.x));
        const int lastY = static_cast<int>(std::floor(high.y));
        for (int y = static_cast<int>(std::ceil(low.y)); y <= lastY; ++y) {
            for (int x = static_cast<int>(std::ceil(low.x)); x <= lastX; ++x) {
                const glm::dvec2 q(x, y);
                const double b1 = cross(q - p[0], p[2] - p[0]) / area;
                const double b2 = cross(p[1] - p[0], q - p[0]) / area;
                const double b0 = 1.0 - b1 - b2;
                if (b0 >= kEdge && b1 >= kEdge && b2 >= kEdge) {
                    set(x, y, chart, mix(mesh.positions, v, b0, b1, b2),
                        mix(mesh.normals, v, b0, b1, b2));
                }
            }
        }
    }

    static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

    static glm::dvec3 mix(const std::vector<glm::vec3>& values,
                          const std::array<std::uint32_t, 3>& v, double b0, double b1, double b2) {
        return glm::dvec3(values[v[0]]) * b0 + glm::dvec3(values[v[1]]) * b1 +
               glm::dvec3(values[v[2]]) * b2;
    }

    void set(int x, int y, std::int32_t chart, const glm::dvec3& position,
             const glm::dvec3& normal) {
        const std::size_t i = static_cast<std::size_t>(wrapped(y, mAtlas.height)) *
                                  static_cast<std::size_t>(mAtlas.width) +
                              static_cast<std::size_t>(wrapped(x, mAtlas.width));
        if (mAtlas.chart[i] >= 0) {
            // The neighbor across a shared edge is no overlap: it lies in the same place.
            const double apart = glm::distance(position, glm::dvec3(mAtlas.positionMm[i]));
            mAtlas.overlaps += apart > 1e-4 * (1.0 + glm::length(position)) ? 1 : 0;
            return;
        }
        mAtlas.chart[i] = chart;
        mAtlas.positionMm[i] = glm::vec3(position);
        const double length = glm::length(normal);
        mAtlas.normal[i] =
            length > 1e-12 ? glm::vec3(normal / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    }

    subedit::SurfaceAtlas mAtlas;
    std::int32_t mCharts = 0;
};

} // namespace

subedit::SurfaceAtlas makeSurfaceAtlas(const World& world, int material, int width, int height) {
    CELADON_ASSERT(width > 0 && height > 0);
    AtlasRasterizer rasterizer(width, height);
    for (const WorldMesh& part : world.meshes) {
        if (part.scattering == material && !part.mesh.uvs.empty()) {
            rasterizer.add(part.mesh);
        }
    }
    return rasterizer.take();
}

} // namespace celadon
