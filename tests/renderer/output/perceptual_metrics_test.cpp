#include "renderer/output/flip.h"
#include "renderer/output/separable_filter.h"
#include "renderer/output/ssim.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace celadon {
namespace {

using test::noiseImage;
using test::uniformImage;
const std::vector<std::string> kRgb{"R", "G", "B"};

FloatImage uniform(float r, float g, float b, int side = 16) {
    return uniformImage(side, side, kRgb, {r, g, b});
}

/// Half black, half white, with an edge down the middle, moved by `shift` pixels.
FloatImage edge(int shift) {
    FloatImage image = uniform(0, 0, 0, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 16 + shift; x < 32; ++x) {
            for (int c = 0; c < 3; ++c) {
                image.at(x, y, c) = 1.0f;
            }
        }
    }
    return image;
}

TEST(SeparableFilter, KeepsConstantsAndMovesImpulses) {
    Plane plane(7, 5);
    std::fill(plane.values.begin(), plane.values.end(), 3.0);
    const std::vector<double> kernel = gaussianKernel(1.5, 5);
    EXPECT_NEAR(std::accumulate(kernel.begin(), kernel.end(), 0.0), 1.0, 1e-12);
    for (const double value : filterSeparable(plane, kernel, kernel).values) {
        EXPECT_NEAR(value, 3.0, 1e-12);
    }
    std::fill(plane.values.begin(), plane.values.end(), 0.0);
    plane.values[2 * 7 + 3] = 1.0;
    const std::vector<double> left{0.0, 0.0, 1.0}; // correlation: reads the right neighbor
    const std::vector<double> stay{1.0};
    EXPECT_EQ(filterSeparable(plane, left, stay).values[2 * 7 + 2], 1.0);
    EXPECT_EQ(filterSeparable(plane, stay, left).values[1 * 7 + 3], 1.0);
}

TEST(Ssim, IsExactlyOneForEqualPictures) {
    const FloatImage image = noiseImage(20, 17, kRgb, 3);
    EXPECT_EQ(structuralSimilarity(image, image), 1.0);
}

TEST(Ssim, HasTheClosedFormForUniformPictures) {
    // No variance: (2 ab + C1) / (a^2 + b^2 + C1), C1 = 1e-4
    EXPECT_NEAR(structuralSimilarity(uniform(0.5f, 0.5f, 0.5f), uniform(0.7f, 0.7f, 0.7f)),
                (0.7 + 1e-4) / (0.74 + 1e-4), 1e-6);
}

TEST(Ssim, IsNegativeForANegativeAndSymmetric) {
    const FloatImage a = noiseImage(24, 24, kRgb, 4);
    FloatImage negative = a;
    for (float& value : negative.pixels) {
        value = 1.0f - value;
    }
    EXPECT_LT(structuralSimilarity(a, negative), -0.5);
    const FloatImage b = noiseImage(24, 24, kRgb, 5);
    EXPECT_EQ(structuralSimilarity(a, b), structuralSimilarity(b, a));
}

TEST(Ssim, TakesPicturesSmallerThanItsWindow) {
    const FloatImage tiny = noiseImage(3, 1, kRgb, 6);
    EXPECT_EQ(structuralSimilarity(tiny, tiny), 1.0);
}

TEST(Flip, IsZeroForEqualPictures) {
    const FloatImage image = noiseImage(24, 20, kRgb, 7);
    for (const float value : flipMap(image, image).pixels) {
        EXPECT_EQ(value, 0.0f);
    }
}

TEST(Flip, IsSymmetricAndInRange) {
    const FloatImage a = noiseImage(24, 20, kRgb, 8);
    const FloatImage b = noiseImage(24, 20, kRgb, 9);
    const FloatImage ab = flipMap(a, b);
    EXPECT_EQ(ab.pixels, flipMap(b, a).pixels);
    for (const float value : ab.pixels) {
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 1.0f);
    }
}

TEST(Flip, HasTheValueOfBlackAgainstWhite) {
    // By hand: HyAB = 100 and, for the largest distance (green to blue, Hunt-adjusted), 203.3;
    // 100^0.7 = 25.12 is above 0.4 * 203.3^0.7 = 16.51, so 0.95 + 0.05 (25.12 - 16.51) / 24.76.
    EXPECT_NEAR(meanValue(flipMap(uniform(0, 0, 0), uniform(1, 1, 1))), 0.9674, 2e-4);
}

TEST(Flip, IsOneForTheFarthestColors) {
    EXPECT_NEAR(meanValue(flipMap(uniform(0, 1, 0), uniform(0, 0, 1))), 1.0, 1e-5);
}

TEST(Flip, GrowsWithTheDifference) {
    double last = 0.0;
    for (const float other : {0.52f, 0.55f, 0.6f, 0.8f, 1.0f}) {
        const double value =
            meanValue(flipMap(uniform(other, other, other), uniform(0.5f, 0.5f, 0.5f)));
        EXPECT_GT(value, last);
        last = value;
    }
}

TEST(Flip, SeesAMovedEdgeMoreThanAnEqualChangeOfArea) {
    const FloatImage map = flipMap(edge(0), edge(1));
    // Where the edge moved; far from it nothing differs.
    EXPECT_GT(map.at(16, 16, 0), 0.5f);
    EXPECT_LT(map.at(2, 16, 0), 1e-3f);
    EXPECT_LT(map.at(30, 16, 0), 1e-3f);
}

TEST(Flip, SeesFineNoiseLessFromAfar) {
    const FloatImage gray = uniform(0.5f, 0.5f, 0.5f, 32);
    FloatImage checker = gray;
    for (std::size_t i = 0; i < checker.pixels.size(); ++i) {
        checker.pixels[i] += ((i / 3) % 32 + (i / 3) / 32) % 2 == 0 ? 0.05f : -0.05f;
    }
    EXPECT_LT(meanValue(flipMap(checker, gray, 134.0)), meanValue(flipMap(checker, gray, 33.0)));
}

TEST(HdrFlip, IsZeroForEqualPicturesAndBlackOnes) {
    FloatImage bright = noiseImage(16, 16, kRgb, 10);
    for (float& value : bright.pixels) {
        value *= 1000.0f;
    }
    EXPECT_EQ(meanValue(hdrFlipMap(bright, bright)), 0.0);
    EXPECT_EQ(meanValue(hdrFlipMap(uniform(0, 0, 0), uniform(0, 0, 0))), 0.0);
}

TEST(HdrFlip, SeesDifferencesThatOneExposureClips) {
    // Both far above white: alike on a display, not at a shorter exposure.
    const FloatImage a = uniform(50, 50, 50);
    const FloatImage b = uniform(100, 100, 100);
    EXPECT_EQ(meanValue(flipMap(a, b)), 0.0);
    EXPECT_GT(meanValue(hdrFlipMap(a, b)), 0.05);
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfLight) {
    const FloatImage a = noiseImage(16, 16, kRgb, 11);
    const FloatImage b = noiseImage(16, 16, kRgb, 12);
    FloatImage scaledA = a;
    FloatImage scaledB = b;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        scaledA.pixels[i] *= 64.0f;
        scaledB.pixels[i] *= 64.0f;
    }
    EXPECT_NEAR(meanValue(hdrFlipMap(a, b)), meanValue(hdrFlipMap(scaledA, scaledB)), 1e-4);
}

} // namespace
} // namespace celadon
