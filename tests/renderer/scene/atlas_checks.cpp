#include "tests/renderer/scene/atlas_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace celadon::test {
namespace {

using Corners = std::array<glm::dvec2, 3>;

Corners cornersOf(const AtlasMesh& atlas, std::size_t t) {
    return {atlas.uvs[atlas.indices[3 * t]], atlas.uvs[atlas.indices[3 * t + 1]],
            atlas.uvs[atlas.indices[3 * t + 2]]};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Height over the longest side, relative to it; and that side's length.
double thickness(const Mesh& mesh, std::size_t t) {
    const glm::dvec3 a = mesh.positions[mesh.indices[3 * t]];
    const glm::dvec3 b = mesh.positions[mesh.indices[3 * t + 1]];
    const glm::dvec3 c = mesh.positions[mesh.indices[3 * t + 2]];
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return longest > 0.0 ? glm::length(glm::cross(b - a, c - a)) / (longest * longest) : 0.0;
}

template<typename Visit>
void forTriangles(std::span<const Mesh* const> meshes, const Atlas& atlas, Visit&& visit) {
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        for (std::size_t t = 0; t < meshes[m]->triangleCount(); ++t) {
            visit(*meshes[m], atlas.meshes[m], t);
        }
    }
}

/// Separating axes of a triangle and the unit square at (x, y).
bool touches(const Corners& p, int x, int y) {
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 side = p[(k + 1) % 3] - p[k];
        const glm::dvec2 axis(-side.y, side.x);
        double low = 1e300, high = -1e300, squareLow = 1e300, squareHigh = -1e300;
        for (int i = 0; i < 3; ++i) {
            low = std::min(low, glm::dot(p[i], axis));
            high = std::max(high, glm::dot(p[i], axis));
        }
        for (int i = 0; i < 4; ++i) {
            const double d = glm::dot(glm::dvec2(x + i % 2, y + i / 2), axis);
            squareLow = std::min(squareLow, d);
            squareHigh = std::max(squareHigh, d);
        }
        if (high < squareLow || squareHigh < low) {
            return false;
        }
    }
    return true;
}

} // namespace

void expectWellFormed(std::span<const Mesh* const> meshes, const Atlas& atlas) {
    ASSERT_EQ(atlas.meshes.size(), meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Mesh& mesh = *meshes[m];
        const AtlasMesh& result = atlas.meshes[m];
        ASSERT_EQ(result.indices.size(), mesh.indices.size());
        ASSERT_EQ(result.chartOfTriangle.size(), mesh.triangleCount());
        ASSERT_EQ(result.uvs.size(), result.sourceVertex.size());
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            ASSERT_LT(result.indices[i], result.uvs.size());
            ASSERT_EQ(result.sourceVertex[result.indices[i]], mesh.indices[i]);
        }
        for (const glm::vec2& uv : result.uvs) {
            ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)
                << uv.x << ' ' << uv.y;
        }
        for (const std::uint32_t chart : result.chartOfTriangle) {
            ASSERT_LT(chart, static_cast<std::uint32_t>(atlas.report.charts));
        }
    }
    EXPECT_GT(atlas.report.coverage, 0.0);
    EXPECT_LE(atlas.report.coverage, 1.0);
    EXPECT_GE(atlas.report.areaDistortionMean, 1.0 - 1e-9);
    EXPECT_GE(atlas.report.areaDistortionMax, atlas.report.areaDistortionMean - 1e-9);
}

void expectOriented(std::span<const Mesh* const> meshes, const Atlas& atlas) {
    int wrong = 0;
    forTriangles(meshes, atlas, [&](const Mesh& mesh, const AtlasMesh& result, std::size_t t) {
        if (thickness(mesh, t) < 1e-3) {
            return;
        }
        const Corners p = cornersOf(result, t);
        // v runs down: what is counterclockwise on the surface is clockwise in (u, v).
        wrong += cross(p[1] - p[0], p[2] - p[0]) < 0.0 ? 0 : 1;
    });
    EXPECT_EQ(wrong, 0);
}

void expectNoOverlap(std::span<const Mesh* const> meshes, const Atlas& atlas, int resolution) {
    // Corners are floats; points so near to an edge may fall on either side.
    constexpr double kRounding = 1e-3;
    std::vector<std::uint8_t> hits(static_cast<std::size_t>(resolution) * resolution, 0);
    forTriangles(meshes, atlas, [&](const Mesh&, const AtlasMesh& result, std::size_t t) {
        Corners p = cornersOf(result, t);
        for (glm::dvec2& q : p) {
            q = q * static_cast<double>(resolution) - 0.5;
        }
        const glm::dvec2 low = glm::ceil(glm::min(glm::min(p[0], p[1]), p[2]));
        const glm::dvec2 high = glm::floor(glm::max(glm::max(p[0], p[1]), p[2]));
        for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
            for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
                bool inside = x >= 0 && y >= 0 && x < resolution && y < resolution;
                for (int k = 0; k < 3 && inside; ++k) {
                    const glm::dvec2 side = p[(k + 1) % 3] - p[k];
                    inside = cross(side, glm::dvec2(x, y) - p[k]) < -kRounding * glm::length(side);
                }
                if (inside) {
                    ++hits[static_cast<std::size_t>(y) * resolution + x];
                }
            }
        }
    });
    EXPECT_EQ(std::count_if(hits.begin(), hits.end(), [](std::uint8_t n) { return n > 1; }), 0);
}

void expectGutter(std::span<const Mesh* const> meshes, const Atlas& atlas, int resolution,
                  int gutter) {
    std::vector<int> owner(static_cast<std::size_t>(resolution) * resolution, -1);
    int shared = 0;
    int atBorder = 0;
    forTriangles(meshes, atlas, [&](const Mesh& mesh, const AtlasMesh& result, std::size_t t) {
        if (thickness(mesh, t) <= 0.0) {
            return;
        }
        Corners p = cornersOf(result, t);
        for (glm::dvec2& q : p) {
            q *= static_cast<double>(resolution);
        }
        const glm::dvec2 low = glm::floor(glm::min(glm::min(p[0], p[1]), p[2]));
        const glm::dvec2 high = glm::floor(glm::max(glm::max(p[0], p[1]), p[2]));
        const int chart = static_cast<int>(result.chartOfTriangle[t]);
        for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
            for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
                if (!touches(p, x, y)) {
                    continue;
                }
                if (x < gutter || y < gutter || x >= resolution - gutter ||
                    y >= resolution - gutter) {
                    ++atBorder;
                    continue;
                }
                int& texel = owner[static_cast<std::size_t>(y) * resolution + x];
                shared += texel >= 0 && texel != chart ? 1 : 0;
                texel = chart;
            }
        }
    });
    EXPECT_EQ(atBorder, 0);
    EXPECT_EQ(shared, 0);
    int tooNear = 0;
    for (int y = 0; y < resolution; ++y) {
        for (int x = 0; x < resolution; ++x) {
            const int chart = owner[static_cast<std::size_t>(y) * resolution + x];
            const auto at = [&](int column, int row) {
                return owner[static_cast<std::size_t>(row) * resolution + column];
            };
            if (chart < 0 || (x > 0 && y > 0 && x + 1 < resolution && y + 1 < resolution &&
                              at(x - 1, y) == chart && at(x + 1, y) == chart &&
                              at(x, y - 1) == chart && at(x, y + 1) == chart)) {
                continue; // nothing, or inside
            }
            for (int dy = 0; dy <= gutter && y + dy < resolution; ++dy) {
                for (int dx = dy == 0 ? 1 : -gutter; dx <= gutter; ++dx) {
                    if (dx * dx + dy * dy > gutter * gutter || x + dx < 0 || x + dx >= resolution) {
                        continue;
                    }
                    const int other = at(x + dx, y + dy);
                    tooNear += other >= 0 && other != chart ? 1 : 0;
                }
            }
        }
    }
    EXPECT_EQ(tooNear, 0);
}

Atlas expectGoodAtlas(std::span<const Mesh* const> meshes, const AtlasSettings& settings) {
    Atlas atlas = generateAtlas(meshes, settings);
    expectWellFormed(meshes, atlas);
    if (!testing::Test::HasFatalFailure()) {
        expectOriented(meshes, atlas);
        expectNoOverlap(meshes, atlas, 2 * settings.resolution);
        EXPECT_EQ(atlas.report.gutterTexels, settings.gutterTexels);
        expectGutter(meshes, atlas, settings.resolution, settings.gutterTexels);
    }
    return atlas;
}

Atlas expectGoodAtlas(const Mesh& mesh, const AtlasSettings& settings) {
    const Mesh* one = &mesh;
    return expectGoodAtlas(std::span(&one, 1), settings);
}

bool sameBytes(const Atlas& a, const Atlas& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    return std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(),
                      [&](const AtlasMesh& x, const AtlasMesh& y) {
                          return same(x.sourceVertex, y.sourceVertex) && same(x.uvs, y.uvs) &&
                                 same(x.indices, y.indices) &&
                                 same(x.chartOfTriangle, y.chartOfTriangle);
                      });
}

} // namespace celadon::test
