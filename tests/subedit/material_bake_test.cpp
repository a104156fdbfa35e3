#include "subedit/errors.h"
#include "subedit/map/material_bake.h"
#include "subedit/models/normalized_diffusion.h"
#include "subedit/radius_map.h"
#include "subedit/recipes/noise.h"
#include "subedit/recipes/recipes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace celadon::subedit {
namespace {

AppearanceMap ramp() {
    AppearanceMap map;
    map.width = 9;
    map.height = 1;
    for (int x = 0; x < 9; ++x) {
        const float t = static_cast<float>(x) / 8.0f;
        map.albedo.push_back({0.1f + 0.85f * t, 0.5f, 1.0f - t});
        map.effectiveRadius.push_back({2.0f + 10.0f * t, 8.0f, 1.0f + t});
    }
    return map;
}

TEST(MaterialBake, KeepsEveryTexelsAlbedo) {
    const AppearanceMap appearance = ramp();
    const MaterialMap map = bakeAppearance(appearance);
    const std::vector<float> albedo = albedoMap(map);
    for (std::size_t i = 0; i < 9; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            // Single precision; black is the floor, some 1e-9.
            EXPECT_NEAR(albedo[i * 3 + static_cast<std::size_t>(channel)],
                        appearance.albedo[i][channel], 1e-5f);
        }
    }
}

TEST(MaterialBake, GivesTheRadiiThatWereAskedFor) {
    const AppearanceMap appearance = ramp();
    const MaterialMap map = bakeAppearance(appearance, {.segments = 64});
    for (int x = 0; x < 8; ++x) {
        const glm::dvec3 radius = effectiveRadiusMm(profileAt(map, x, 0));
        const glm::vec3 asked = appearance.effectiveRadius[static_cast<std::size_t>(x)];
        // What lies beyond r_s comes back at the center (0.1 % of the energy, 2 % of R_P); a range
        // of two segments is represented by so many.
        EXPECT_NEAR(radius.x, static_cast<double>(asked.x), 0.03 * static_cast<double>(asked.x));
        EXPECT_NEAR(radius.y, static_cast<double>(asked.y), 0.03 * static_cast<double>(asked.y));
    }
}

TEST(MaterialBake, AMapOfOneRangeNeedsNoTable) {
    AppearanceMap appearance;
    appearance.width = appearance.height = 1;
    appearance.albedo = {glm::vec3(0.7f)};
    appearance.effectiveRadius = {glm::vec3(5.0f)};
    const MaterialMap map = bakeAppearance(appearance);
    EXPECT_TRUE(map.isHomogeneous());
    EXPECT_NEAR(diffuseAlbedo(profileAt(map, 0, 0)).y, 0.7, 1e-5);
}

TEST(MaterialBake, RadiusFromMeanFreePathHolds95Percent) {
    const glm::vec3 radius = effectiveRadiusFromMeanFreePath(glm::vec3(0.8f), glm::vec3(2.0f));
    const RadialCurves curves = normalizedDiffusionProfile(glm::dvec3(0.8), glm::dvec3(2.0));
    EXPECT_NEAR(curves[0].energyWithin(static_cast<double>(radius.x)) / curves[0].total, 0.95,
                1e-6);
}

TEST(Noise, Tiles) {
    for (int i = 0; i < 50; ++i) {
        const float t = static_cast<float>(i) / 50.0f;
        // Coordinates beyond 1 lose a few bits.
        EXPECT_NEAR(fractalNoise({t, 0.0f}, 5, 4, 1u), fractalNoise({t, 1.0f}, 5, 4, 1u), 1e-4f);
        EXPECT_NEAR(fractalNoise({-1.0f, t}, 5, 4, 1u), fractalNoise({2.0f, t}, 5, 4, 1u), 1e-4f);
        EXPECT_NEAR(cellularNoise({t, 0.0f}, 7, 1u).nearest,
                    cellularNoise({t, 1.0f}, 7, 1u).nearest, 1e-4f);
        EXPECT_EQ(cellularNoise({0.31f, t}, 7, 1u).id, cellularNoise({1.31f, t}, 7, 1u).id);
    }
}

TEST(Noise, IsCenteredAndBounded) {
    double sum = 0.0;
    for (int i = 0; i < 10000; ++i) {
        const glm::vec2 uv(static_cast<float>(i % 100) / 100.0f,
                           static_cast<float>(i / 100) / 99.0f);
        const float value = gradientNoise(uv, 17, 5u);
        ASSERT_LT(std::abs(value), 0.75f); // sqrt(1/2) for gradients of length 1
        sum += static_cast<double>(value);
    }
    EXPECT_NEAR(sum / 10000.0, 0.0, 0.02);
}

TEST(Noise, SmoothStepTakesItsEdgesInEitherOrder) {
    EXPECT_EQ(smoothStep(0.2f, 0.4f, 0.1f), 0.0f);
    EXPECT_EQ(smoothStep(0.2f, 0.4f, 0.5f), 1.0f);
    EXPECT_EQ(smoothStep(0.4f, 0.2f, 0.5f), 0.0f);
    EXPECT_FLOAT_EQ(smoothStep(0.4f, 0.2f, 0.3f), 0.5f);
}

class RecipeTest : public testing::TestWithParam<Recipe> {};

TEST_P(RecipeTest, IsDeterministicAndPhysical) {
    const Recipe& recipe = GetParam();
    const int size = std::min(recipe.size, 32);
    const BakeSettings settings{.segments = recipe.segments};
    const MaterialMap map = recipe.bake(size, settings);
    EXPECT_EQ(map.logProfile, recipe.bake(size, settings).logProfile);
    EXPECT_EQ(map.width, size);
    EXPECT_EQ(map.segments, recipe.segments);
    for (const float value : map.logProfile) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_GE(value, kLogProfileFloor);
    }
    for (const float albedo : albedoMap(map)) {
        ASSERT_GT(albedo, 0.0f);
        ASSERT_LT(albedo, 0.98f);
    }
    for (const float radius : effectiveRadiusMap(map)) {
        ASSERT_GT(radius, 2.0f); // of an object of 100 mm, as in Chen et al. 2012, Table 1 ...
        ASSERT_LT(radius, 22.0f);
    }
}

INSTANTIATE_TEST_SUITE_P(All, RecipeTest, testing::ValuesIn(recipes().begin(), recipes().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Recipes, AreSortedAndAnUnknownOneListsThem) {
    EXPECT_TRUE(std::ranges::is_sorted(recipes(), {}, &Recipe::name));
    try {
        static_cast<void>(findRecipe("plastic"));
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("yellow_wax"));
    }
}

TEST(Recipes, ChessboardHasSharpBorders) {
    const MaterialMap map = findRecipe("marble_chessboard").bake(64, {});
    const std::vector<float> albedo = albedoMap(map);
    for (std::size_t i = 0; i < 64; ++i) {
        const float green = albedo[(32 * 64 + i) * 3 + 1];
        EXPECT_TRUE(green < 0.2f || green > 0.8f) << i;
    }
}

} // namespace
} // namespace celadon::subedit
