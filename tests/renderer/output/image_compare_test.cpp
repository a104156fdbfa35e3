#include "renderer/output/image_compare.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

using test::noiseImage;
using test::uniformImage;
using Names = std::vector<std::string>;

TEST(CompareValues, HasTheAnswersOfAHandMadeCase) {
    FloatImage a = uniformImage(2, 1, {"Y"}, {0.0f});
    FloatImage b = a;
    a.pixels = {1.0f, 5.0f};
    b.pixels = {4.0f, 1.0f}; // e = 3, 4
    const ValueErrors errors = compareValues(a, b);
    EXPECT_DOUBLE_EQ(errors.rmse, std::sqrt(12.5));
    EXPECT_DOUBLE_EQ(errors.relativeRmse, std::sqrt(12.5 / 8.5));
    EXPECT_DOUBLE_EQ(errors.peak, 5.0);
    EXPECT_NEAR(errors.psnr, 20.0 * std::log10(5.0 / std::sqrt(12.5)), 1e-12);
    EXPECT_DOUBLE_EQ(errors.meanRatio, 6.0 / 5.0);
    EXPECT_DOUBLE_EQ(errors.mean, 3.5);
    EXPECT_DOUBLE_EQ(errors.max, 4.0);
    EXPECT_DOUBLE_EQ(errors.p50, 3.0);
    EXPECT_DOUBLE_EQ(errors.p99, 4.0);
}

TEST(CompareValues, GivesTwentyDecibelsForATenthOfThePeak) {
    const ValueErrors errors =
        compareValues(uniformImage(4, 4, {"R", "G", "B"}, {0.5f, 0.5f, 0.5f}),
                      uniformImage(4, 4, {"R", "G", "B"}, {0.6f, 0.6f, 0.6f}));
    EXPECT_NEAR(errors.rmse, 0.1, 1e-7);
    EXPECT_NEAR(errors.psnr, 20.0, 1e-5);
}

TEST(CompareValues, IsExactOnEqualPictures) {
    const FloatImage image = noiseImage(9, 7, {"R", "G", "B"}, 1);
    const ValueErrors errors = compareValues(image, image);
    EXPECT_EQ(errors.rmse, 0.0);
    EXPECT_EQ(errors.relativeRmse, 0.0);
    EXPECT_EQ(errors.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(errors.meanRatio, 1.0);
    EXPECT_EQ(errors.max, 0.0);
}

TEST(CompareValues, IsSymmetricWhereTheMetricIs) {
    const FloatImage a = noiseImage(9, 7, {"R", "G", "B"}, 1);
    const FloatImage b = noiseImage(9, 7, {"R", "G", "B"}, 2);
    const ValueErrors ab = compareValues(a, b);
    const ValueErrors ba = compareValues(b, a);
    EXPECT_EQ(ab.rmse, ba.rmse);
    EXPECT_EQ(ab.psnr, ba.psnr);
    EXPECT_EQ(ab.p95, ba.p95);
    EXPECT_NE(ab.relativeRmse, ba.relativeRmse);
}

TEST(CompareValues, HasNoRatioToABlackReference) {
    const FloatImage black = uniformImage(2, 2, {"Y"}, {0.0f});
    const FloatImage gray = uniformImage(2, 2, {"Y"}, {0.5f});
    EXPECT_TRUE(std::isinf(compareValues(gray, black).relativeRmse));
    EXPECT_TRUE(std::isinf(compareValues(gray, black).meanRatio));
    EXPECT_EQ(compareValues(black, black).relativeRmse, 0.0);
    EXPECT_EQ(compareValues(black, black).meanRatio, 1.0);
}

TEST(Percentile, IsTheNearestRank) {
    const std::vector<float> values{40, 15, 50, 20, 35};
    EXPECT_EQ(percentile(values, 5), 15);
    EXPECT_EQ(percentile(values, 30), 20);
    EXPECT_EQ(percentile(values, 40), 20);
    EXPECT_EQ(percentile(values, 50), 35);
    EXPECT_EQ(percentile(values, 100), 50);
    EXPECT_EQ(percentile(values, 0), 15);
}

TEST(FindNonFinite, TellsWhereTheFirstOneIs) {
    FloatImage image = uniformImage(3, 2, {"R", "G"}, {0.0f, 0.0f});
    EXPECT_FALSE(findNonFinite(image).has_value());
    image.at(1, 1, 1) = std::numeric_limits<float>::quiet_NaN();
    image.at(2, 1, 0) = std::numeric_limits<float>::infinity();
    const auto found = findNonFinite(image);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->count, 2u);
    EXPECT_EQ(found->x, 1);
    EXPECT_EQ(found->y, 1);
    EXPECT_EQ(found->channel, "G");
}

TEST(ExtractLayer, TakesColorsInOneOrderWithoutAlpha) {
    const FloatImage image = uniformImage(
        2, 1, {"A", "B", "G", "R", "exitance.B", "exitance.G", "exitance.R", "radius", "normal.X"},
        {9, 3, 2, 1, 6, 5, 4, 7, 8});
    const FloatImage color = extractLayer(image, "");
    EXPECT_EQ(color.channels, (Names{"R", "G", "B"}));
    EXPECT_EQ(color.pixels, (std::vector<float>{1, 2, 3, 1, 2, 3}));
    const FloatImage exitance = extractLayer(image, "exitance");
    EXPECT_EQ(exitance.channels, (Names{"R", "G", "B"}));
    EXPECT_EQ(exitance.at(1, 0, 2), 6.0f);
    EXPECT_EQ(extractLayer(image, "radius").channels, (Names{"radius"}));
    EXPECT_EQ(extractLayer(image, "normal").channels, (Names{"X"}));
    EXPECT_TRUE(extractLayer(image, "exit").channels.empty());
}

TEST(ErrorMap, HoldsTheLargestOfTheChannels) {
    const FloatImage map = errorMap(uniformImage(1, 1, {"R", "G"}, {1.0f, 2.0f}),
                                    uniformImage(1, 1, {"R", "G"}, {1.5f, 0.0f}));
    EXPECT_EQ(map.pixels, (std::vector<float>{2.0f}));
}

TEST(HeatMap, GrowsLighterFromBlack) {
    FloatImage values = uniformImage(64, 1, {"error"}, {0.0f});
    for (int x = 0; x < 64; ++x) {
        values.at(x, 0, 0) = static_cast<float>(x);
    }
    const FloatImage map = heatMap(values, 63.0f);
    EXPECT_EQ(map.at(0, 0, 0) + map.at(0, 0, 1) + map.at(0, 0, 2), 0.0f);
    float last = -1.0f;
    for (int x = 0; x < 64; ++x) {
        const float luma =
            0.2126f * map.at(x, 0, 0) + 0.7152f * map.at(x, 0, 1) + 0.0722f * map.at(x, 0, 2);
        EXPECT_GT(luma, last);
        last = luma;
    }
    EXPECT_GT(last, 0.9f);
}

TEST(HeatMap, IsBlackWhereNothingDiffers) {
    const FloatImage map = heatMap(uniformImage(2, 2, {"error"}, {0.0f}), 0.0f);
    EXPECT_EQ(map.pixels, std::vector<float>(12, 0.0f));
}

} // namespace
} // namespace celadon
