#include "subedit/edit/apply_operator.h"
#include "subedit/effective_radius.h"
#include "subedit/fast_log.h"
#include "subedit/map/material_bake.h"
#include "tests/subedit/support/profiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace celadon::subedit {
namespace {

const ProfileLayout kLayout{32, 30.0f};

std::vector<float> profile(const glm::vec3& lengthMm = {2.0f, 1.5f, 1.0f}, float scale = 0.02f) {
    return test::exponentialMaterial(kLayout.segments, kLayout.maxRadiusMm, lengthMm, scale)
        .logProfile;
}

StoredProfile stored(std::vector<float> logProfile) {
    return {kLayout.segments, kLayout.maxRadiusMm, std::move(logProfile)};
}

std::vector<float> edited(const EditOperator& op, const std::vector<float>& before,
                          float weight = 1.0f, TexelOutcome* outcome = nullptr,
                          float largestRadiusMm = 120.0f) {
    static const Surface surface(makeFlatSurface(1, 1, 1.0f)); // its texel is at (0.5, -0.5, 0)
    MaterialMap map;
    map.width = map.height = 1;
    map.segments = kLayout.segments;
    map.maxRadiusMm = kLayout.maxRadiusMm;
    map.logProfile = before;
    const MapSource source(map);
    const PreparedOperator prepared(op, kLayout, largestRadiusMm, surface, source);
    PreparedOperator::Worker worker(prepared);
    std::vector<float> after(before.size());
    const TexelOutcome result = worker.evaluate(0, before.data(), weight, after.data());
    if (outcome != nullptr) {
        *outcome = result;
    }
    return after;
}

ProfileView view(const std::vector<float>& logProfile) {
    return {logProfile.data(), kLayout.segments, kLayout.maxRadiusMm};
}

glm::dvec3 albedoOf(const std::vector<float>& p) {
    return diffuseAlbedo(view(p));
}

glm::dvec3 radiusOf(const std::vector<float>& p) {
    return effectiveRadiusMm(view(p));
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double relative,
                const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(actual[c] / expected[c], 1.0, relative) << what << ", channel " << c;
    }
}

/// Every operator, with numbers that do something.
std::vector<EditOperator> allOperators() {
    return {ScaleAlbedo{{0.5f, 0.8f, 1.4f}},
            SetAlbedo{{0.2f, 0.5f, 0.9f}},
            Tint{{1.0f, 0.6f, 0.3f}, 0.8f},
            ScaleRange{{0.6f, 1.2f, 1.5f}},
            SetRange{{5.0f, 5.0f, 5.0f}},
            SetShape{stored(profile({1.0f, 1.0f, 1.0f}))},
            Mix{stored(profile({0.7f, 2.5f, 1.4f}, 0.03f)), 0.7f},
            Gradient{stored(profile({1.0f, 1.0f, 1.0f})),
                     stored(profile({2.0f, 2.0f, 2.0f})),
                     {0.0f, 0.0f, 0.0f},
                     {1.0f, 0.0f, 0.0f}}};
}

// In float, the shift of ln P is rounded once per knot.
constexpr double kAlbedoTolerance = 3e-6;
// Profiles are linear between knots: another range or shape bends a little at other places.
constexpr double kRangeTolerance = 5e-3;

TEST(Operator, WeightZeroChangesNoBit) {
    const std::vector<float> before = profile();
    for (const EditOperator& op : allOperators()) {
        EXPECT_EQ(edited(op, before, 0.0f), before) << operatorName(op);
    }
}

TEST(Operator, NeverBringsEnergyAboveOne) {
    const std::vector<float> bright = profile({2.0f, 1.5f, 1.0f}, 0.039f); // A of 0.98 in red
    for (const EditOperator& op : allOperators()) {
        for (const float weight : {0.1f, 0.5f, 1.0f}) {
            const glm::dvec3 albedo = albedoOf(edited(op, bright, weight));
            EXPECT_LE(std::max({albedo.x, albedo.y, albedo.z}), 1.0) << operatorName(op);
        }
    }
    TexelOutcome outcome;
    const glm::dvec3 clamped =
        albedoOf(edited(ScaleAlbedo{{3.0f, 1.0f, 1.0f}}, bright, 1.0f, &outcome));
    EXPECT_TRUE(outcome.energyClamped);
    EXPECT_NEAR(clamped.x, 1.0, 1e-5);
    static_cast<void>(edited(ScaleAlbedo{{0.9f, 1.0f, 1.0f}}, bright, 1.0f, &outcome));
    EXPECT_FALSE(outcome.energyClamped);
}

TEST(Operator, AlbedoEditsLeaveRangeAndShape) {
    const std::vector<float> before = profile();
    const std::vector<float> after = edited(ScaleAlbedo{{0.5f, 0.8f, 1.3f}}, before);
    expectNear(albedoOf(after), albedoOf(before) * glm::dvec3(0.5, 0.8, 1.3), kAlbedoTolerance,
               "albedo");
    expectNear(radiusOf(after), radiusOf(before), 1e-6, "range");
    for (std::size_t i = 3; i < before.size() - 30; ++i) { // above the floor: a common factor
        EXPECT_NEAR(after[i] - before[i], after[i % 3] - before[i % 3], 1e-5f);
    }
    expectNear(albedoOf(edited(SetAlbedo{{0.3f, 0.4f, 0.5f}}, before)), {0.3, 0.4, 0.5},
               kAlbedoTolerance, "set");
}

TEST(Operator, TintKeepsLuminance) {
    const std::vector<float> before = profile();
    const auto luminance = [](const glm::dvec3& a) {
        return 0.2126 * a.x + 0.7152 * a.y + 0.0722 * a.z;
    };
    const glm::dvec3 after = albedoOf(edited(Tint{{0.9f, 0.7f, 0.4f}, 1.0f}, before));
    EXPECT_NEAR(luminance(after), luminance(albedoOf(before)), 1e-5);
    EXPECT_NEAR(after.x / after.y, 0.9 / 0.7, 1e-4);
    EXPECT_NEAR(after.z / after.y, 0.4 / 0.7, 1e-4);
}

TEST(Operator, RangeEditsLeaveAlbedoAndScaleLengths) {
    const std::vector<float> before = profile({1.5f, 1.2f, 1.0f}); // twice that fits r_s
    for (const float factor : {0.5f, 0.8f, 1.25f, 2.0f}) {
        const std::vector<float> after = edited(ScaleRange{glm::vec3(factor)}, before);
        expectNear(albedoOf(after), albedoOf(before), kAlbedoTolerance, "albedo");
        expectNear(radiusOf(after), radiusOf(before) * static_cast<double>(factor), kRangeTolerance,
                   "range");
        // P(r / s) / s^2 where the segments have resolved it.
        const glm::dvec3 here = glm::dvec3(after[12], after[13], after[14]); // at r = 4 h
        const double h = 30.0 / 32.0;
        for (int c = 0; c < 3; ++c) {
            const double length = c == 0 ? 1.5 : (c == 1 ? 1.2 : 1.0);
            const double expected = std::log(0.02) - 4.0 * h / factor / length -
                                    2.0 * std::log(static_cast<double>(factor));
            EXPECT_NEAR(here[c], expected, 0.02) << "factor " << factor;
        }
    }
    expectNear(radiusOf(edited(SetRange{{6.0f, 5.0f, 4.0f}}, before)), {6.0, 5.0, 4.0},
               kRangeTolerance, "set");
}

/// Profiles of real materials are infinite at the center and bend most where knots are few.
TEST(Operator, RangeEditsHitTheRangeOfBakedProfilesToo) {
    AppearanceMap appearance;
    appearance.width = appearance.height = 1;
    appearance.albedo = {{0.9f, 0.6f, 0.4f}};
    appearance.effectiveRadius = {{10.0f, 8.0f, 6.0f}};
    BakeSettings settings;
    settings.segments = kLayout.segments;
    settings.maxRadiusMm = static_cast<double>(kLayout.maxRadiusMm);
    const std::vector<float> before = bakeAppearance(appearance, settings).logProfile;
    for (const float factor : {0.5f, 0.7f, 0.9f, 1.1f, 1.3f}) {
        const std::vector<float> after = edited(ScaleRange{glm::vec3(factor)}, before);
        expectNear(albedoOf(after), albedoOf(before), kAlbedoTolerance, "albedo");
        // Measured: 0.9 % at half the range, where R_P is three segments.
        expectNear(radiusOf(after), radiusOf(before) * static_cast<double>(factor), 0.02, "range");
    }
    expectNear(radiusOf(edited(SetRange{{5.0f, 5.0f, 5.0f}}, before)), {5.0, 5.0, 5.0}, 0.02,
               "set");
}

TEST(Operator, ShapeEditsLeaveAlbedoAndRange) {
    const std::vector<float> before = profile({2.0f, 1.8f, 1.6f});
    // A Gaussian, of another albedo and range.
    StoredProfile gauss = stored(before);
    for (int k = 0; k <= kLayout.segments; ++k) {
        const float r = static_cast<float>(k) * kLayout.spacingMm() / 9.0f;
        for (std::size_t c = 0; c < 3; ++c) {
            gauss.logProfile[static_cast<std::size_t>(k) * 3 + c] =
                std::max(-r * r * 4.0f - 3.0f, kLogProfileFloor);
        }
    }
    for (const float weight : {0.3f, 1.0f}) {
        const std::vector<float> after = edited(SetShape{gauss}, before, weight);
        expectNear(albedoOf(after), albedoOf(before), kAlbedoTolerance, "albedo");
        expectNear(radiusOf(after), radiusOf(before), kRangeTolerance, "range");
    }
    // Half the energy lies farther out, in units of R_P, than for an exponential.
    const std::vector<float> after = edited(SetShape{gauss}, before);
    const glm::dvec3 half = effectiveRadiusMm(view(after), 0.5) / radiusOf(after);
    const glm::dvec3 gaussHalf =
        effectiveRadiusMm(gauss.view(), 0.5) / effectiveRadiusMm(gauss.view());
    expectNear(half, gaussHalf, 0.01, "shape");
}

TEST(Operator, FastLogarithmIsOne) {
    for (float x = 1e-35f; x < 1e35f; x *= 1.37f) {
        const double expected = std::log(static_cast<double>(x));
        ASSERT_NEAR(static_cast<double>(fastLog(x)), expected,
                    2e-7 * std::max(1.0, std::abs(expected)))
            << x;
    }
    EXPECT_EQ(fastLog(1.0f), 0.0f);
}

TEST(Operator, ReplacingGivesTheProfileItself) {
    const std::vector<float> q = profile({0.9f, 1.1f, 1.9f}, 0.03f);
    EXPECT_EQ(edited(Mix{stored(q), 1.0f}, profile()), q);
    const glm::dvec3 mixed = albedoOf(edited(Mix{stored(q), 0.25f}, profile()));
    expectNear(mixed, 0.75 * albedoOf(profile()) + 0.25 * albedoOf(q), kAlbedoTolerance, "mix");
}

TEST(Operator, AlbedoAndRangeCommute) {
    const ScaleAlbedo dim{{0.5f, 0.7f, 0.9f}};
    const ScaleAlbedo dimmer{{0.8f, 0.6f, 0.5f}};
    const ScaleRange shrink{{0.7f, 0.8f, 1.1f}};
    const std::vector<float> before = profile();
    const auto expectSame = [&](const EditOperator& a, const EditOperator& b, double tolerance) {
        for (const float weight : {0.3f, 1.0f}) {
            const std::vector<float> ab = edited(b, edited(a, before, weight), weight);
            const std::vector<float> ba = edited(a, edited(b, before, weight), weight);
            for (std::size_t i = 0; i < ab.size(); ++i) {
                if (ab[i] > kLogProfileFloor + 1.0f) {
                    EXPECT_NEAR(ab[i], ba[i], tolerance)
                        << operatorName(a) << ", " << operatorName(b) << ", value " << i;
                }
            }
        }
    };
    expectSame(dim, dimmer, 1e-5);
    expectSame(dim, shrink, 1e-4); // the first knot is solved for, to some 1e-5
}

TEST(Operator, SaysWhatRadiusItNeeds) {
    const std::vector<float> before = profile({4.0f, 1.5f, 1.0f}, 0.005f);
    TexelOutcome outcome;
    static_cast<void>(edited(ScaleRange{glm::vec3(2.0f)}, before, 1.0f, &outcome));
    EXPECT_GT(outcome.neededRadiusMm, kLayout.maxRadiusMm);
    EXPECT_FALSE(outcome.rangeClamped);
    static_cast<void>(edited(ScaleRange{glm::vec3(2.0f)}, before, 1.0f, &outcome, 35.0f));
    EXPECT_TRUE(outcome.rangeClamped);
    EXPECT_LE(outcome.neededRadiusMm, 35.0f * 1.00001f);
    static_cast<void>(edited(ScaleRange{glm::vec3(0.5f)}, before, 1.0f, &outcome));
    EXPECT_LE(outcome.neededRadiusMm, kLayout.maxRadiusMm);
}

TEST(Operator, ABlackTexelCanBeLitAndStaysBlackWhenScaled) {
    std::vector<float> black(kLayout.values(), kLogProfileFloor);
    EXPECT_LT(albedoOf(edited(ScaleAlbedo{glm::vec3(5.0f)}, black)).x, 1e-6);
    expectNear(albedoOf(edited(SetAlbedo{glm::vec3(0.5f)}, black)), glm::dvec3(0.5),
               kAlbedoTolerance, "lit");
    EXPECT_LT(albedoOf(edited(SetAlbedo{glm::vec3(0.0f)}, profile())).y, 1e-6);
    for (const EditOperator& op : allOperators()) {
        for (const float value : edited(op, black, 0.5f)) {
            ASSERT_TRUE(std::isfinite(value)) << operatorName(op);
        }
    }
}

} // namespace
} // namespace celadon::subedit
