#include "renderer/scene/environment.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace celadon {
namespace {

EnvironmentMap constantMap(int width, int height, glm::vec3 radiance) {
    EnvironmentMap map;
    map.width = width;
    map.height = height;
    map.radiance.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                        radiance);
    return map;
}

glm::vec3& texel(EnvironmentMap& map, int x, int y) {
    return map.radiance[static_cast<std::size_t>(y * map.width + x)];
}

TEST(EnvironmentLights, ConstantMapGivesFourPiAndPullsNowhere) {
    for (const int count : {1, 2, 7, 16, 64, 256}) {
        const EnvironmentMap map = constantMap(64, 32, {0.5f, 1.0f, 2.0f});
        const std::vector<Light> lights = environmentLights(map, count);
        ASSERT_EQ(lights.size(), static_cast<std::size_t>(count));
        glm::dvec3 color(0.0);
        glm::dvec3 balance(0.0);
        for (const Light& light : lights) {
            EXPECT_EQ(light.kind, Light::Kind::Directional);
            EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-9);
            color += light.color;
            balance += light.direction * light.color.y;
        }
        const double whole = 4.0 * glm::pi<double>();
        EXPECT_NEAR(color.x, 0.5 * whole, 1e-9);
        EXPECT_NEAR(color.y, whole, 1e-9);
        EXPECT_NEAR(color.z, 2.0 * whole, 1e-9);
        if (count >= 16) {
            EXPECT_LT(glm::length(balance), 0.05 * whole) << count;
        }
    }
}

TEST(EnvironmentLights, RegionsHaveAboutEqualPower) {
    const std::vector<Light> lights = environmentLights(constantMap(256, 128, glm::vec3(1.0f)), 64);
    const double share = 4.0 * glm::pi<double>() / 64.0;
    for (const Light& light : lights) {
        EXPECT_NEAR(light.color.x, share, 0.2 * share);
    }
}

TEST(EnvironmentLights, OneBrightTexelIsOneLightFromThere) {
    struct Place {
        int x, y;
        glm::dvec3 towards;
    };
    // 8 x 4 texels: the convention of environment.h, at texel centers.
    const double c = std::cos(glm::pi<double>() / 8.0);
    const double s = std::sin(glm::pi<double>() / 8.0);
    for (const Place& place : {Place{4, 0, {s * s, c, -c * s}}, Place{3, 3, {-s * s, -c, -c * s}},
                               Place{6, 1, {c * c, s, s * c}}, Place{0, 1, {-s * c, s, c * c}}}) {
        EnvironmentMap map = constantMap(8, 4, glm::vec3(0.0f));
        texel(map, place.x, place.y) = {3.0f, 2.0f, 1.0f};
        const std::vector<Light> lights = environmentLights(map, 16);
        ASSERT_EQ(lights.size(), 1u);
        EXPECT_NEAR(glm::distance(-lights[0].direction, place.towards), 0.0, 1e-9);
        EXPECT_NEAR(lights[0].color.x / lights[0].color.z, 3.0, 1e-9);
        EXPECT_EQ(environmentRadiance(map, place.towards), glm::vec3(3.0f, 2.0f, 1.0f));
    }
}

TEST(EnvironmentLights, EachLitTexelIsALightWhenThereAreFewOfThem) {
    EnvironmentMap map = constantMap(32, 16, glm::vec3(0.0f));
    texel(map, 0, 0) = glm::vec3(1e6f);
    texel(map, 31, 15) = glm::vec3(1e-6f);
    texel(map, 16, 8) = glm::vec3(1.0f);
    texel(map, 17, 8) = glm::vec3(1.0f);
    EXPECT_EQ(environmentLights(map, 64).size(), 4u);
    EXPECT_EQ(environmentLights(map, 2).size(), 2u);
    EXPECT_TRUE(environmentLights(map, 0).empty());
    EXPECT_TRUE(environmentLights(constantMap(32, 16, glm::vec3(0.0f)), 64).empty());
}

TEST(EnvironmentLights, ASunTakesOneLightAndLeavesTheRestToTheSky) {
    EnvironmentMap map = constantMap(64, 32, glm::vec3(1.0f));
    texel(map, 20, 10) = glm::vec3(1e5f);
    const std::vector<Light> lights = environmentLights(map, 32);
    ASSERT_EQ(lights.size(), 32u);
    double sun = 0.0;
    double total = 0.0;
    for (const Light& light : lights) {
        sun = std::max(sun, light.color.x);
        total += light.color.x;
    }
    EXPECT_NEAR(total - sun, 4.0 * glm::pi<double>(), 0.05);
}

TEST(EnvironmentRadiance, FollowsTheConvention) {
    EnvironmentMap map = constantMap(64, 32, glm::vec3(0.0f));
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            texel(map, x, y) = glm::vec3(glm::dvec3((x + 0.5) / 64.0, (y + 0.5) / 32.0, 0.0));
        }
    }
    constexpr float kHalfTexel = 0.5f / 32.0f;
    EXPECT_NEAR(environmentRadiance(map, {0, 1, 0}).y, kHalfTexel, 1e-6); // row 0 is up
    EXPECT_NEAR(environmentRadiance(map, {0, -1, 0}).y, 1.0 - kHalfTexel, 1e-6);
    EXPECT_NEAR(environmentRadiance(map, {0, 0, -1}).x, 0.5, 1e-6); // the center looks along -z
    EXPECT_NEAR(environmentRadiance(map, {1, 0, 0}).x, 0.75, 1e-6); // u grows towards +x
    EXPECT_NEAR(environmentRadiance(map, {-1, 0, 0}).x, 0.25, 1e-6);
    EXPECT_NEAR(environmentRadiance(map, {0, 0, -1}).y, 0.5, 1e-6);
}

TEST(EnvironmentRadiance, IsContinuousOverTheSeamAndThePoles) {
    EnvironmentMap map = constantMap(16, 8, glm::vec3(0.0f));
    for (int i = 0; i < 128; ++i) {
        map.radiance[static_cast<std::size_t>(i)] = glm::vec3(static_cast<float>(i * 37 % 101));
    }
    for (const double tilt : {0.3, 1.0, -0.7}) {
        const double step = 1e-7;
        EXPECT_NEAR(environmentRadiance(map, glm::normalize(glm::dvec3(-step, tilt, 1.0))).x,
                    environmentRadiance(map, glm::normalize(glm::dvec3(step, tilt, 1.0))).x, 1e-3);
        EXPECT_NEAR(
            environmentRadiance(map, glm::normalize(glm::dvec3(step * tilt, 1.0, step))).x,
            environmentRadiance(map, glm::normalize(glm::dvec3(-step * tilt, 1.0, -step))).x, 1e-3);
    }
}

} // namespace
} // namespace celadon
