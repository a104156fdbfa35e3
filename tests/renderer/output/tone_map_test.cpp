#include "renderer/output/tone_map.h"
#include "subedit/errors.h"
#include "tests/support/images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace celadon {
namespace {

using test::uniformImage;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Srgb, HasTheStandardsValues) {
    EXPECT_EQ(encodeSrgb(0.0f), 0.0f);
    EXPECT_NEAR(encodeSrgb(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(encodeSrgb(0.5f), 0.7353569f, 1e-6f);
    EXPECT_NEAR(encodeSrgb(0.001f), 0.01292f, 1e-7f);  // on the straight piece
    EXPECT_NEAR(encodeSrgb(0.21404114f), 0.5f, 1e-6f); // middle gray
    EXPECT_NEAR(decodeSrgb(128.0f / 255.0f), 0.2158605f, 1e-6f);
}

TEST(Srgb, DecodesWhatItEncodes) {
    for (int i = 0; i <= 1000; ++i) {
        const float x = static_cast<float>(i) / 1000.0f;
        EXPECT_NEAR(decodeSrgb(encodeSrgb(x)), x, 2e-6f);
    }
}

TEST(Srgb, ClampsAndTakesNaNForZero) {
    EXPECT_EQ(encodeSrgb(-1.0f), 0.0f);
    EXPECT_EQ(encodeSrgb(kNaN), 0.0f);
    EXPECT_EQ(encodeSrgb(7.0f), encodeSrgb(1.0f));
    EXPECT_EQ(encodeSrgb(kInfinity), encodeSrgb(1.0f));
}

class AnyToneMap : public testing::TestWithParam<ToneMap> {};

TEST_P(AnyToneMap, IsMonotonousFromBlackAndStaysInRange) {
    EXPECT_EQ(applyToneMap(GetParam(), glm::vec3(0.0f)), glm::vec3(0.0f));
    float last = 0.0f;
    for (int i = 1; i <= 400; ++i) {
        const float x = 0.05f * static_cast<float>(i);
        const glm::vec3 y = applyToneMap(GetParam(), glm::vec3(x));
        EXPECT_GE(y.x, last - 1e-6f);
        EXPECT_LE(y.x, 1.0f);
        EXPECT_NEAR(y.x, y.y, 1e-6f); // gray stays gray
        EXPECT_NEAR(y.x, y.z, 1e-6f);
        last = y.x;
    }
}

TEST_P(AnyToneMap, SurvivesUglyValues) {
    for (const glm::vec3 color :
         {glm::vec3(kNaN), glm::vec3(kInfinity, 0.0f, 1.0f), glm::vec3(-3.0f, 1e38f, 0.1f)}) {
        const glm::vec3 y = applyToneMap(GetParam(), color);
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(y[c], 0.0f);
            EXPECT_LE(y[c], 1.0f);
        }
    }
}

TEST_P(AnyToneMap, HasANameThatIsParsed) {
    EXPECT_EQ(parseToneMap(toneMapName(GetParam())), GetParam());
    EXPECT_THROW(static_cast<void>(parseToneMap("filmic")), UsageError);
}

INSTANTIATE_TEST_SUITE_P(All, AnyToneMap,
                         testing::Values(ToneMap::Neutral, ToneMap::Aces, ToneMap::None));

TEST(NeutralToneMap, OnlyTakesOutTheReflectionBelowItsShoulder) {
    // The specification: base colors up to 0.8 - 0.04 come back, less a Fresnel offset of 0.04.
    const glm::vec3 y = applyToneMap(ToneMap::Neutral, {0.5f, 0.3f, 0.2f});
    EXPECT_NEAR(y.x, 0.46f, 1e-6f);
    EXPECT_NEAR(y.y, 0.26f, 1e-6f);
    EXPECT_NEAR(y.z, 0.16f, 1e-6f);
}

TEST(NeutralToneMap, CompressesHighlightsByItsFormula) {
    // peak 1.96, start 0.76, d = 0.24: 1 - 0.24^2 / (1.96 + 0.24 - 0.76) = 0.96
    EXPECT_NEAR(applyToneMap(ToneMap::Neutral, glm::vec3(2.0f)).x, 0.96f, 1e-6f);
}

TEST(AcesToneMap, HasTheCurvesValue) {
    // x = 0.6: (0.6 (2.51 * 0.6 + 0.03)) / (0.6 (2.43 * 0.6 + 0.59) + 0.14)
    EXPECT_NEAR(applyToneMap(ToneMap::Aces, glm::vec3(1.0f)).x, 0.9216f / 1.3688f, 1e-6f);
}

TEST(ToDisplay, UnpremultipliesBeforeTheCurve) {
    const FloatImage in = uniformImage(2, 1, {"R", "G", "B", "A"}, {0.1f, 0.2f, 0.4f, 0.5f});
    DisplaySettings settings;
    settings.toneMap = ToneMap::None;
    const FloatImage out = toDisplay(in, settings);
    ASSERT_EQ(out.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_NEAR(out.at(1, 0, 0), encodeSrgb(0.2f), 1e-6f);
    EXPECT_NEAR(out.at(1, 0, 1), encodeSrgb(0.4f), 1e-6f);
    EXPECT_NEAR(out.at(1, 0, 2), encodeSrgb(0.8f), 1e-6f);
    EXPECT_EQ(out.at(1, 0, 3), 0.5f);
}

TEST(ToDisplay, LeavesTheBackgroundWhiteWhateverTheExposure) {
    const FloatImage in = uniformImage(1, 1, {"R", "G", "B", "A"}, {0, 0, 0, 0});
    for (const ToneMap toneMap : {ToneMap::Neutral, ToneMap::Aces, ToneMap::None}) {
        const FloatImage out = toDisplay(in, {-3.0f, toneMap, glm::vec3(1.0f)});
        EXPECT_EQ(out.channelCount(), 3u);
        EXPECT_NEAR(out.at(0, 0, 1), 1.0f, 1e-6f);
    }
}

TEST(ToDisplay, MixesObjectAndBackgroundInLinearLight) {
    const FloatImage in = uniformImage(1, 1, {"R", "G", "B", "A"}, {0.0f, 0.5f, 0.0f, 0.5f});
    const FloatImage out = toDisplay(in, {0.0f, ToneMap::None, glm::vec3(0.0f, 0.0f, 1.0f)});
    EXPECT_NEAR(out.at(0, 0, 0), 0.0f, 1e-6f);
    EXPECT_NEAR(out.at(0, 0, 1), encodeSrgb(0.5f), 1e-6f);
    EXPECT_NEAR(out.at(0, 0, 2), encodeSrgb(0.5f), 1e-6f);
}

TEST(ToDisplay, DoublesLightWithOneStopOfExposure) {
    const FloatImage in = uniformImage(1, 1, {"B", "G", "R"}, {0.1f, 0.2f, 0.3f});
    const FloatImage out = toDisplay(in, {1.0f, ToneMap::None, std::nullopt});
    EXPECT_NEAR(out.at(0, 0, 0), encodeSrgb(0.6f), 1e-6f); // channels by name, not by place
    EXPECT_NEAR(out.at(0, 0, 2), encodeSrgb(0.2f), 1e-6f);
}

TEST(ToDisplay, RefusesPicturesWithoutColor) {
    EXPECT_THROW(static_cast<void>(toDisplay(uniformImage(1, 1, {"Y"}, {1.0f}), {})), UsageError);
}

TEST(CompositeOver, AddsWhatIsNotCovered) {
    const FloatImage in =
        uniformImage(1, 1, {"R", "G", "B", "A", "radius"}, {0.1f, 0.2f, 0.3f, 0.25f, 7.0f});
    const FloatImage out = compositeOver(in, {1.0f, 2.0f, 0.0f});
    EXPECT_FLOAT_EQ(out.at(0, 0, 0), 0.85f);
    EXPECT_FLOAT_EQ(out.at(0, 0, 1), 1.7f);
    EXPECT_FLOAT_EQ(out.at(0, 0, 2), 0.3f);
    EXPECT_EQ(out.at(0, 0, 3), 1.0f);
    EXPECT_EQ(out.at(0, 0, 4), 7.0f);
}

} // namespace
} // namespace celadon
