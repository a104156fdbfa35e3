// What the samples of a pixel have in common: asked pixel by pixel in the plainest way.
#include "renderer/shading/sample_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace celadon {
namespace {

constexpr std::size_t kSamples = 4;

/// 0-based; of triangles counted from 1.
std::size_t meshOf(std::uint32_t number, const std::vector<std::uint32_t>& meshEnds) {
    std::size_t mesh = 0;
    while (number > meshEnds[mesh]) {
        ++mesh;
    }
    return mesh;
}

class SampleRanges : public testing::TestWithParam<std::vector<std::uint32_t>> {};

TEST_P(SampleRanges, SaysWhatAllSamplesShow) {
    const std::vector<std::uint32_t>& meshEnds = GetParam();
    constexpr std::size_t kPixels = 40000; // several tasks
    std::mt19937 engine(5);
    const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
    std::vector<std::uint32_t> triangles(kSamples * kPixels);
    std::vector<float> depths(kSamples * kPixels, -7.0f); // undefined where nothing is seen
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        // All of some pixels see nothing, and many see neighbors.
        const std::size_t pixel = i % kPixels;
        triangles[i] = pixel % 3 == 0   ? 0
                       : pixel % 3 == 1 ? random() % (meshEnds.back() + 1)
                                        : 1 + (static_cast<std::uint32_t>(pixel) + random() % 2) %
                                                  meshEnds.back();
        if (triangles[i] != 0) {
            depths[i] = std::uniform_real_distribution<float>(0.1f, 1.0f)(engine);
        }
    }
    std::vector<glm::vec2> ranges;
    findSampleRanges(triangles, depths, kPixels, meshEnds, ranges);
    ASSERT_EQ(ranges.size(), kPixels);
    int counts[3] = {};
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
        std::size_t seen = 0;
        std::vector<std::size_t> meshes;
        glm::vec2 expected(2.0f, 0.0f);
        for (std::size_t s = 0; s < kSamples; ++s) {
            const std::size_t i = s * kPixels + pixel;
            if (triangles[i] != 0) {
                ++seen;
                meshes.push_back(meshOf(triangles[i], meshEnds));
                expected = {std::min(expected.x, depths[i]), std::max(expected.y, depths[i])};
            }
        }
        const bool isOne =
            seen == kSamples && std::ranges::count(meshes, meshes.front()) == std::ptrdiff_t(seen);
        if (seen == 0) {
            expected = glm::vec2(0.0f);
        } else if (!isOne) {
            expected = glm::vec2(-1.0f);
        }
        ++counts[seen == 0 ? 0 : isOne ? 1 : 2];
        ASSERT_EQ(ranges[pixel], expected) << pixel;
    }
    EXPECT_GT(*std::ranges::min_element(counts), 1000);
}

INSTANTIATE_TEST_SUITE_P(Meshes, SampleRanges,
                         testing::Values(std::vector<std::uint32_t>{9},
                                         std::vector<std::uint32_t>{3, 3, 8, 20}));

} // namespace
} // namespace celadon
