#include "renderer/scene/chart_packing.h"
#include "renderer/scene/profile_curve.h"
#include "renderer/scene/surface_builder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace celadon {
namespace {

TEST(ProfileCurve, GoesThroughItsPointsByArcLength) {
    const std::vector<glm::dvec2> points{{0, 0}, {3, 1}, {4, 5}, {1, 8}};
    const ProfileCurve curve(points);
    EXPECT_NEAR(glm::distance(curve.at(0.0), points.front()), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(curve.at(curve.length()), points.back()), 0.0, 1e-12);
    for (const glm::dvec2& point : {points[1], points[2]}) {
        EXPECT_NEAR(glm::distance(curve.at(curve.atHeight(point.y)), point), 0.0, 1e-3);
    }
    // Equal steps of the parameter are equal ways.
    const double step = curve.length() / 100.0;
    for (double s = 0.0; s + step < curve.length(); s += step) {
        EXPECT_NEAR(glm::distance(curve.at(s), curve.at(s + step)), step, 0.01 * step);
        EXPECT_NEAR(glm::length(curve.tangent(s)), 1.0, 1e-12);
    }
}

TEST(ProfileCurve, AStraightLineStaysStraight) {
    const ProfileCurve curve({{0, 0}, {1, 2}, {2, 4}, {3, 6}});
    for (double s = 0.0; s < curve.length(); s += 0.1) {
        const glm::dvec2 p = curve.at(s);
        EXPECT_NEAR(p.y, 2.0 * p.x, 1e-12);
    }
    EXPECT_NEAR(curve.length(), std::hypot(3.0, 6.0), 1e-9);
}

TEST(PackCharts, KeepsAllApartAndInside) {
    const std::vector<glm::dvec2> sizes{{5, 9}, {20, 3}, {7, 7}, {1, 1}, {2, 8}, {9, 5}, {4, 4}};
    constexpr double kMargin = 0.5;
    const ChartPacking packing = packCharts(sizes, kMargin);
    ASSERT_EQ(packing.corners.size(), sizes.size());
    double area = 0.0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const glm::dvec2 low = packing.corners[i];
        const glm::dvec2 high = low + sizes[i];
        area += sizes[i].x * sizes[i].y;
        EXPECT_GE(std::min(low.x, low.y), kMargin - 1e-12);
        EXPECT_LE(std::max(high.x, high.y), packing.side - kMargin + 1e-12);
        for (std::size_t j = 0; j < i; ++j) {
            const glm::dvec2 gap =
                glm::max(packing.corners[j] - high, low - packing.corners[j] - sizes[j]);
            EXPECT_GE(std::max(gap.x, gap.y), kMargin - 1e-12) << i << " " << j;
        }
    }
    EXPECT_GT(area / (packing.side * packing.side), 0.4);
}

TEST(SurfaceBuilder, NormalsJoinWherePositionsAreEqual) {
    // Two patches that meet at a right angle share the mean normal along the edge.
    SurfaceBuilder builder;
    builder.addGrid(1, 1, [](int column, int row) {
        return SurfacePoint{{column - 1.0, 1.0 - row, 0.0}, {column, row}};
    });
    builder.addGrid(1, 1, [](int column, int row) {
        return SurfacePoint{{0.0, 1.0 - row, -static_cast<double>(column)}, {1.0 + column, row}};
    });
    const Scene scene = builder.finish("corner", 2.0);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.triangleCount(), 4u);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i].x == 0.0f && mesh.positions[i].z == 0.0f) {
            EXPECT_NEAR(glm::dot(mesh.normals[i], glm::vec3(1, 0, 1)), std::sqrt(2.0f), 1e-5f);
        }
    }
    EXPECT_EQ(mesh.uvs[1], glm::vec2(0.5f, 0.0f));
}

} // namespace
} // namespace celadon
