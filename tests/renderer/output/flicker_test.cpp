#include "renderer/output/flicker.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

using test::noiseImage;
using test::uniformImage;

FloatImage gray(std::vector<float> values) {
    FloatImage image = uniformImage(static_cast<int>(values.size()), 1, {"Y"}, {0.0f});
    image.pixels = std::move(values);
    return image;
}

TEST(Flicker, HasTheAnswersOfAHandMadeCase) {
    const FloatImage t0 = gray({3.0f, 4.0f});
    const FloatImage t1 = gray({4.0f, 3.0f}); // changes by 1, -1; values of sum of squares 25
    const FloatImage j0 = gray({3.0f, 4.0f});
    const FloatImage j1 = gray({7.0f, -1.0f}); // changes by 4, -5: 3, -4 beyond truth
    const Flicker flicker = measureFlicker({j0, j1}, {t0, t1});
    EXPECT_DOUBLE_EQ(flicker.trueChange, std::sqrt(2.0 / 25.0));
    EXPECT_DOUBLE_EQ(flicker.beyondTruth, 1.0);
    EXPECT_EQ(flickerMap({j0, j1}, {t0, t1}).pixels, (std::vector<float>{3.0f, 4.0f}));
}

TEST(Flicker, AnErrorThatStandsStillDoesNotCount) {
    const FloatImage t0 = noiseImage(8, 6, {"R", "G", "B"}, 1);
    const FloatImage t1 = noiseImage(8, 6, {"R", "G", "B"}, 2);
    FloatImage j0 = t0;
    FloatImage j1 = t1;
    for (std::size_t i = 0; i < j0.pixels.size(); ++i) {
        const float error = 0.25f * static_cast<float>(i % 3);
        j0.pixels[i] += error;
        j1.pixels[i] += error;
    }
    EXPECT_LT(measureFlicker({j0, j1}, {t0, t1}).beyondTruth, 1e-6);
    EXPECT_EQ(measureFlicker({t0, t1}, {t0, t1}).beyondTruth, 0.0);
    // The same pictures in the other order do flicker.
    EXPECT_GT(measureFlicker({j1, j0}, {t0, t1}).beyondTruth, 0.1);
}

TEST(Flicker, BlackTruthIsNoNumberOnlyWhereSomethingMoves) {
    const FloatImage black = gray({0.0f, 0.0f});
    const FloatImage white = gray({1.0f, 1.0f});
    EXPECT_EQ(measureFlicker({black, black}, {black, black}).beyondTruth, 0.0);
    EXPECT_EQ(measureFlicker({white, white}, {black, black}).beyondTruth, 0.0);
    EXPECT_EQ(measureFlicker({black, white}, {black, black}).beyondTruth,
              std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace celadon
