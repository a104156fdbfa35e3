#include "reference_support.h"
#include "renderer/reference/incidence.h"
#include "renderer/reference/light_view.h"
#include "renderer/shading/fresnel.h"

#include <gtest/gtest.h>

namespace celadon {
namespace {

using namespace celadon::testing;

double totalFlux(const std::vector<Patch>& patches) {
    double sum = 0;
    for (const Patch& patch : patches) {
        sum += static_cast<double>(patch.flux.x);
    }
    return sum;
}

World sphereWorld(float eta = 1.0f) {
    return makeWorld({{makeSphere(50, 64)}},
                     {makeHomogeneous({1, 1, 1}, 20, glm::dvec3(0.9), eta)});
}

TEST(Incidence, PointLightFollowsTheInverseSquareInMeters) {
    const Light light = pointLight({0, 0, 2000}, {8, 4, 2});
    const Incidence incidence = incidenceAt(light, {0, 0, 0});
    EXPECT_DOUBLE_EQ(incidence.irradiance.x, 2.0);
    EXPECT_DOUBLE_EQ(incidence.distanceMm, 2000.0);
    EXPECT_EQ(incidence.toLight, glm::dvec3(0, 0, 1));
    EXPECT_EQ(incidenceAt(light, light.position).irradiance, glm::dvec3(0));
}

TEST(Incidence, DirectionalLightIsTheSameEverywhere) {
    const Light light = directionalLight({0, 3, -4}, {8, 4, 2});
    for (const double x : {0.0, 1e5}) {
        const Incidence incidence = incidenceAt(light, {x, 0, 0});
        EXPECT_EQ(incidence.irradiance, glm::dvec3(8, 4, 2));
        EXPECT_NEAR(incidence.toLight.y, -0.6, 1e-15);
        EXPECT_TRUE(std::isinf(incidence.distanceMm));
    }
}

TEST(Incidence, SpotFallsFromInnerToOuterConeAsGltfHasIt) {
    Light light = pointLight({0, 0, 0});
    light.kind = Light::Kind::Spot;
    light.direction = {0, 0, -1};
    light.innerConeRadians = 0.2;
    light.outerConeRadians = 0.5;
    const auto factor = [&](double angle) {
        return spotFactor(light, {std::sin(angle), 0, -std::cos(angle)});
    };
    EXPECT_DOUBLE_EQ(factor(0.0), 1.0);
    EXPECT_DOUBLE_EQ(factor(0.2), 1.0);
    EXPECT_EQ(factor(0.5001), 0.0);
    EXPECT_EQ(factor(3.0), 0.0);
    const double ramp = (std::cos(0.4) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5));
    EXPECT_NEAR(factor(0.4), ramp * ramp, 1e-12);
    light.innerConeRadians = 0.5; // a hard edge
    EXPECT_EQ(factor(0.52), 0.0);
    EXPECT_EQ(factor(0.48), 1.0);
}

TEST(LightView, SphereInterceptsItsCrossSection) {
    const World world = sphereWorld();
    const std::vector<Patch> patches = lightViewPatches(world, directionalLight({1, 2, 3}), 256);
    const double crossSection = std::numbers::pi * 50 * 50 * 1e-6;
    EXPECT_NEAR(totalFlux(patches) / crossSection, 1.0, 3e-3);
    for (const Patch& patch : patches) {
        EXPECT_NEAR(glm::length(patch.positionMm), 50.0, 0.15);
        EXPECT_LT(glm::dot(patch.positionMm, glm::vec3(1, 2, 3)), 1.0f);
        const float trace = patch.covariance[0] + patch.covariance[3] + patch.covariance[5];
        EXPECT_GE(trace, 2 * (100.0f / 256) * (100.0f / 256) / 12 * 0.99f);
    }
}

TEST(LightView, PointLightGivesIntensityTimesSolidAngle) {
    const World world = sphereWorld();
    for (const double distance : {52.0, 56.0, 60.0, 120.0, 5000.0}) { // six faces, then a frustum
        const std::vector<Patch> patches = lightViewPatches(
            world, pointLight(distance * glm::normalize(glm::dvec3(1, 1, 0.5))), 256);
        const double solidAngle =
            2 * std::numbers::pi * (1 - std::sqrt(1 - std::pow(50 / distance, 2)));
        EXPECT_NEAR(totalFlux(patches) / solidAngle, 1.0, distance < 55 ? 0.02 : 4e-3) << distance;
    }
}

TEST(LightView, LightWithinAClosedDoubleSidedShapeIsAllTaken) {
    World world = sphereWorld();
    EXPECT_EQ(totalFlux(lightViewPatches(world, pointLight({5, 10, -20}), 64)), 0.0);
    world.looks[0].doubleSided = true;
    EXPECT_NEAR(totalFlux(lightViewPatches(world, pointLight({5, 10, -20}), 64)),
                4 * std::numbers::pi, 0.005);
}

TEST(LightView, FresnelTakesItsPart) {
    // A slab seen straight on: one cosine, one factor.
    const World world =
        makeWorld({{makeSlab(40, 2)}}, {makeHomogeneous({1, 1, 1}, 20, glm::dvec3(0.9), 1.5f)});
    const double flux = totalFlux(lightViewPatches(world, directionalLight({0, 0, -1}), 400));
    // The slab's border is half a texel off at most on each side, 0.35 % in each direction.
    EXPECT_NEAR(flux / (40 * 40 * 1e-6), 0.96, 0.008);
}

TEST(LightView, OpaquePartsOutsideTheFrustumShadow) {
    // Far above the slab and far larger than it.
    const World world = makeWorld({{makeSlab(40, 2)}, {makeSlab(900, 1, 700), -1}},
                                  {makeHomogeneous({1, 1, 1}, 20)});
    EXPECT_TRUE(lightViewPatches(world, directionalLight({0, 0, -1}), 32).empty());
    EXPECT_FALSE(lightViewPatches(world, pointLight({0, 0, 500}), 32).empty());
    EXPECT_TRUE(lightViewPatches(world, pointLight({0, 0, 900}), 32).empty());
}

} // namespace
} // namespace celadon
