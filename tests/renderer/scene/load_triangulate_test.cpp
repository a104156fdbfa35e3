#include "renderer/scene/load_triangulate.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace celadon::loaders {

namespace {

using Polygon = std::vector<glm::vec3>;

double areaOf(const Polygon& polygon, const std::array<std::uint32_t, 3>& t) {
    return 0.5 * glm::cross(glm::dvec3(polygon[t[1]] - polygon[t[0]]),
                            glm::dvec3(polygon[t[2]] - polygon[t[0]]))
                     .z;
}

/// Signed areas are all positive and add up to the polygon's: then the triangles tile it.
void expectTiles(const Polygon& polygon) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ASSERT_TRUE(triangulate(polygon, triangles));
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    double total = 0.0;
    for (const auto& triangle : triangles) {
        EXPECT_GT(areaOf(polygon, triangle), 0.0);
        total += areaOf(polygon, triangle);
    }
    double shoelace = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 a(polygon[i]);
        const glm::dvec3 b(polygon[(i + 1) % polygon.size()]);
        shoelace += 0.5 * (a.x * b.y - b.x * a.y);
    }
    EXPECT_NEAR(total, shoelace, 1e-6 * std::abs(shoelace));
}

} // namespace

TEST(Triangulate, QuadWithAReflexCornerIsSplitThroughIt) {
    const Polygon arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5f, 1, 0}};
    for (std::size_t start = 0; start < 4; ++start) {
        Polygon turned = arrow;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start),
                    turned.end());
        expectTiles(turned);
    }
}

TEST(Triangulate, ConvexQuadIsSplitAlongItsShorterDiagonal) {
    const Polygon rhombus{{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}};
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ASSERT_TRUE(triangulate(rhombus, triangles));
    for (const auto& triangle : triangles) {
        EXPECT_EQ(std::count(triangle.begin(), triangle.end(), 1u), 1);
        EXPECT_EQ(std::count(triangle.begin(), triangle.end(), 3u), 1);
    }
}

TEST(Triangulate, RandomStarsAreTiled) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> radius(0.1f, 2.0f);
    for (int corners = 5; corners < 60; ++corners) {
        Polygon star;
        for (int i = 0; i < corners; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(corners);
            const float r = radius(random);
            star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0f);
        }
        expectTiles(star);
    }
}

TEST(Triangulate, CombWithManyReflexCornersIsTiled) {
    Polygon comb{{0, -1, 0}, {200, -1, 0}};
    for (int tooth = 100; tooth-- > 0;) {
        const auto x = static_cast<float>(2 * tooth);
        comb.emplace_back(x + 2.0f, 5.0f, 0.0f);
        comb.emplace_back(x + 1.0f, 0.0f, 0.0f);
    }
    comb.emplace_back(0.0f, 5.0f, 0.0f);
    expectTiles(comb);
}

TEST(Triangulate, StraightCornersGetNoEmptyTriangles) {
    expectTiles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}});
}

TEST(Triangulate, AnyOrientationInSpaceKeepsTheWinding) {
    const Polygon flat{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}};
    for (const glm::vec3 normal : {glm::vec3(1, 0.2f, 0.1f), glm::vec3(-0.3f, 1, 0),
                                   glm::vec3(0, -1, 0.5f), glm::vec3(0.1f, 0.2f, -1)}) {
        const glm::vec3 n = glm::normalize(normal);
        const glm::vec3 u = glm::normalize(glm::cross(n, glm::vec3(0.9f, 0.5f, 0.3f)));
        const glm::vec3 v = glm::cross(n, u);
        Polygon polygon;
        for (const glm::vec3& p : flat) {
            polygon.push_back(u * p.x + v * p.y);
        }
        std::vector<std::array<std::uint32_t, 3>> triangles;
        ASSERT_TRUE(triangulate(polygon, triangles));
        for (const auto& [a, b, c] : triangles) {
            EXPECT_GT(glm::dot(glm::cross(polygon[b] - polygon[a], polygon[c] - polygon[a]), n),
                      0.0f);
        }
    }
}

TEST(Triangulate, DegenerateAndCrossingPolygonsEnd) {
    const std::vector<Polygon> odd{
        Polygon(6, glm::vec3(1.0f)),
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
        {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 5, 0}},
        {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}};
    for (const Polygon& polygon : odd) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        EXPECT_TRUE(triangulate(polygon, triangles));
        EXPECT_EQ(triangles.size(), polygon.size() - 2);
    }
}

TEST(Triangulate, HugePolygonsMustBeConvex) {
    Polygon disk;
    Polygon saw;
    const int corners = 20000;
    for (int i = 0; i < corners; ++i) {
        const double angle = 6.283185307179586 * i / corners;
        disk.emplace_back(std::cos(angle) * 100.0, std::sin(angle) * 100.0, 0.0);
        saw.push_back(disk.back() * (i % 2 == 0 ? 1.0f : 0.5f));
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EXPECT_FALSE(triangulate(saw, triangles));
    EXPECT_TRUE(triangles.empty());
}

} // namespace celadon::loaders
