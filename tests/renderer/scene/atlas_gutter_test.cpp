#include "renderer/scene/atlas_gutter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

Mesh triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    Mesh mesh;
    mesh.positions.resize(3);
    mesh.uvs = {a, b, c};
    mesh.indices = {0, 1, 2};
    return mesh;
}

std::vector<int> sourceOf(const Mesh& mesh, int width, int height, int radius) {
    const Mesh* one = &mesh;
    return dilationSource(std::span(&one, 1), width, height, radius);
}

TEST(AtlasGutter, CoveredTexelsAreTheirOwnSource) {
    Mesh square = triangle({0, 0}, {1, 0}, {1, 1});
    square.uvs.emplace_back(0, 1);
    square.positions.emplace_back();
    square.indices.insert(square.indices.end(), {0, 2, 3});
    const std::vector<int> source = sourceOf(square, 7, 5, 0);
    for (int i = 0; i < 35; ++i) {
        EXPECT_EQ(source[i], i);
    }
}

TEST(AtlasGutter, NearestCoveredTexelWithinTheRadius) {
    constexpr int kWidth = 40, kHeight = 30, kRadius = 5;
    const Mesh mesh = triangle({0.3f, 0.2f}, {0.7f, 0.4f}, {0.45f, 0.8f});
    const std::vector<int> covered = sourceOf(mesh, kWidth, kHeight, 0);
    const std::vector<int> source = sourceOf(mesh, kWidth, kHeight, kRadius);
    for (int i = 0; i < kWidth * kHeight; ++i) {
        int best = kRadius * kRadius + 1;
        for (int j = 0; j < kWidth * kHeight; ++j) {
            const int dx = j % kWidth - i % kWidth;
            const int dy = j / kWidth - i / kWidth;
            if (covered[j] == j) {
                best = std::min(best, dx * dx + dy * dy);
            }
        }
        if (best > kRadius * kRadius) {
            EXPECT_EQ(source[i], -1);
            continue;
        }
        ASSERT_GE(source[i], 0);
        EXPECT_EQ(covered[source[i]], source[i]);
        const int dx = source[i] % kWidth - i % kWidth;
        const int dy = source[i] / kWidth - i / kWidth;
        EXPECT_EQ(dx * dx + dy * dy, best);
    }
}

TEST(AtlasGutter, TriangleBetweenTexelCentersCoversOne) {
    const std::vector<int> source =
        sourceOf(triangle({0.51f, 0.51f}, {0.52f, 0.51f}, {0.51f, 0.52f}), 8, 8, 0);
    EXPECT_EQ(source[4 * 8 + 4], 4 * 8 + 4);
}

TEST(AtlasGutter, CoordinatesRepeat) {
    const Mesh inside = triangle({0.2f, 0.2f}, {0.6f, 0.3f}, {0.3f, 0.7f});
    Mesh shifted = inside;
    for (glm::vec2& uv : shifted.uvs) {
        uv += glm::vec2(-3.0f, 5.0f);
    }
    EXPECT_EQ(sourceOf(inside, 16, 16, 2), sourceOf(shifted, 16, 16, 2));
}

TEST(AtlasGutter, HostileCoordinatesEndQuickly) {
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float value : {1e9f, 1e38f, infinite, std::nanf("")}) {
        const std::vector<int> source =
            sourceOf(triangle({0, 0}, {value, 0}, {0, value}), 64, 64, 4);
        EXPECT_EQ(source.size(), 64u * 64u);
    }
}

} // namespace
} // namespace celadon
