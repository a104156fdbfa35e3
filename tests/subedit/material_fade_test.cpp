#include "subedit/map/material_fade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace celadon::subedit {
namespace {

MaterialMap exponential(int size, int segments, float radiusMm, float scale, float rate) {
    MaterialMap map;
    map.width = map.height = size;
    map.segments = segments;
    map.maxRadiusMm = radiusMm;
    for (int texel = 0; texel < size * size; ++texel) {
        for (int k = 0; k <= segments; ++k) {
            const float r = radiusMm * static_cast<float>(k) / static_cast<float>(segments);
            for (int c = 0; c < 3; ++c) {
                map.logProfile.push_back(std::log(scale) - rate * r);
            }
        }
    }
    return map;
}

double albedo(const MaterialMap& map, int x, int y) {
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double r = (i + 0.5) / kSteps * double(map.maxRadiusMm);
        const double knot = r / double(map.maxRadiusMm) * map.segments;
        const int k = std::min(static_cast<int>(knot), map.segments - 1);
        const double log = std::lerp(double(map.logKnot(x, y, k).x),
                                     double(map.logKnot(x, y, k + 1).x), knot - k);
        sum += 2.0 * std::numbers::pi * std::exp(log) * r * double(map.maxRadiusMm) / kSteps;
    }
    return sum;
}

TEST(MaterialFade, ItsEndsAreTheMaterialsThemselves) {
    const MaterialMap a = exponential(1, 16, 8.0f, 0.02f, 0.7f);
    const MaterialMap b = exponential(4, 40, 30.0f, 0.005f, 0.2f);
    const MaterialFade fade(a, b);
    EXPECT_EQ(fade.at(0.0).logProfile, a.logProfile);
    EXPECT_EQ(fade.at(-1.0).maxRadiusMm, 8.0f);
    EXPECT_EQ(fade.at(1.0).logProfile, b.logProfile);
    EXPECT_EQ(fade.at(1.0).width, 4);
}

TEST(MaterialFade, LnPIsMixedWhereTheLayoutIsOne) {
    MaterialMap a = exponential(2, 24, 12.0f, 0.02f, 0.7f);
    MaterialMap b = exponential(2, 24, 12.0f, 0.004f, 0.3f);
    a.eta = 1.3f;
    b.eta = 1.5f;
    b.roughness.assign(4, 0.4f);
    const MaterialMap half = MaterialFade(a, b).at(0.25);
    for (std::size_t i = 0; i < a.logProfile.size(); ++i) {
        EXPECT_FLOAT_EQ(half.logProfile[i], 0.75f * a.logProfile[i] + 0.25f * b.logProfile[i]);
    }
    EXPECT_FLOAT_EQ(half.eta, 1.35f);
    EXPECT_EQ(half.roughness, b.roughness);
}

TEST(MaterialFade, RadiiAreReconciledAndTheFadeHasNoJumps) {
    const MaterialMap a = exponential(1, 32, 8.0f, 0.03f, 1.0f);
    const MaterialMap b = exponential(3, 32, 40.0f, 0.003f, 0.2f);
    const MaterialFade fade(a, b);
    const MaterialMap middle = fade.at(0.5);
    EXPECT_EQ(middle.maxRadiusMm, 40.0f);
    EXPECT_EQ(middle.segments, 160); // as close as the first has its knots
    EXPECT_EQ(middle.width, 3);
    const double first = albedo(a, 0, 0);
    EXPECT_NEAR(albedo(fade.at(1e-6), 1, 2), first, 0.01 * first);
    const double last = albedo(b, 1, 2);
    EXPECT_NEAR(albedo(fade.at(1.0 - 1e-6), 1, 2), last, 0.01 * last);
    // From step to step it changes little, and never beyond the two ends' range of reason.
    double before = first;
    for (double t = 0.02; t < 1.0; t += 0.02) {
        const double now = albedo(fade.at(t), 0, 0);
        EXPECT_LT(std::abs(now - before), 0.15 * std::max(first, last)) << t;
        EXPECT_LE(now, 1.01 * std::max(first, last)) << t;
        before = now;
    }
}

} // namespace
} // namespace celadon::subedit
