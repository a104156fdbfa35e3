#include "reference_support.h"
#include "renderer/reference/light_source.h"
#include "renderer/reference/path_traced.h"
#include "renderer/reference/surface_reference.h"
#include "renderer/shading/fresnel.h"
#include "subedit/models/half_space.h"
#include "subedit/models/random_walk.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace celadon {
namespace {

using namespace celadon::testing;
using subedit::Medium;

constexpr double kEta = 1.4;

World bodyOf(std::vector<Part> parts) {
    return makeWorld(std::move(parts),
                     {makeHomogeneous({1, 1, 1}, 20, {0.9, 0.7, 0.5}, float(kEta))});
}

/// Seen from +z: `heightMm` fits the picture.
CameraView viewFromAbove(double heightMm, glm::ivec2 size) {
    Camera camera;
    camera.eye = {0, 0, 200};
    camera.orthographicHeight = heightMm;
    return makeCameraView(camera, size.x, size.y);
}

struct Mean {
    glm::dvec3 value{0.0};
    glm::dvec3 error{0.0}; ///< standard
};
Mean meanOf(const PathTracedResult& result) {
    Mean mean;
    const double n = static_cast<double>(result.exitance.size());
    for (std::size_t i = 0; i < result.exitance.size(); ++i) {
        const glm::dvec3 e(result.standardError[i]);
        mean.value += glm::dvec3(result.exitance[i]) / n;
        mean.error += e * e / (n * n);
    }
    mean.error = glm::sqrt(mean.error);
    return mean;
}

/// Uniform radiance 1 W/m^2/sr from all around, by a spiral of directional lights.
std::vector<Light> uniformLight(int count) {
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const double s = std::sqrt(1.0 - z * z);
        lights.push_back(directionalLight({s * std::cos(phi), s * std::sin(phi), z},
                                          glm::dvec3(4.0 * std::numbers::pi / count)));
    }
    return lights;
}

TEST(PathTraced, WithoutAbsorptionAConvexBodyInUniformLightGivesBackWhatEntersEverywhere) {
    // In equilibrium the radiance within is eta^2 L everywhere, so B = E at every point.
    const World world = bodyOf({{makeSphere(10, 40)}});
    Medium medium;
    medium.reducedScattering = {0.3, 0.5, 0.8};
    medium.eta = kEta;
    const PathTraced solver(world, {.medium = medium, .paths = 200000});
    const glm::ivec2 size(6, 6);
    // The middle of the disc, where a pixel is flat enough to be one place.
    const PathTracedResult result = solver.solve(viewFromAbove(12, size), size, uniformLight(600));
    const double expected = std::numbers::pi * diffuseTransmittance(kEta);
    const Mean mean = meanOf(result);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(result.flux.left[c] / result.flux.entered[c], 1.0, 0.01); // roulette only
        EXPECT_LT(result.flux.lost[c] / result.flux.entered[c], 1e-3);
        EXPECT_NEAR(mean.value[c], expected, 4 * mean.error[c] + 0.003 * expected); // facets
        EXPECT_LT(mean.error[c], 0.01 * expected);
    }
    // Not only on the whole: no pixel stands out by more than chance allows.
    double squares = 0;
    for (std::size_t i = 0; i < result.exitance.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            squares += std::pow((result.exitance[i][c] - expected) / result.standardError[i][c], 2);
        }
    }
    EXPECT_LT(squares / (3.0 * 36.0), 1.6); // 1 expected, 0.14 its own spread, channels correlated
}

TEST(PathTraced, AThickWideSlabReflectsWhatTheHalfSpaceDoes) {
    const World world = bodyOf({{makeBox({60, 60, 30})}});
    Medium medium =
        subedit::mediumFromAlbedo({0.95, 0.8, 0.5}, {0.4, 0.6, 1.0}, kEta); // of different lengths
    for (const double g : {0.0, 0.7}) {
        medium.anisotropy = g;
        const PathTraced solver(world, {.medium = medium, .paths = 200000});
        const glm::ivec2 size(5, 5);
        const std::array lights{directionalLight({0, 0, -1}, {1, 2, 3})};
        const PathTracedResult result =
            solver.solve(viewFromAbove(44, size), size, lights); // 8 mm from the edges
        const subedit::RandomWalkResult walks =
            subedit::simulateRandomWalk(medium, {.walks = 200000});
        const Mean mean = meanOf(result);
        const double entered = fresnelTransmittance(1.0, kEta);
        for (int c = 0; c < 3; ++c) {
            const double expected = g == 0.0 ? subedit::halfSpaceTotal(medium)[c]
                                             : walks.channels[static_cast<std::size_t>(c)].total;
            const double error = walks.channels[static_cast<std::size_t>(c)].totalError;
            const double irradiance = (c + 1) * entered;
            EXPECT_NEAR(mean.value[c] / irradiance, expected,
                        4 * std::hypot(mean.error[c] / irradiance, error))
                << g << ' ' << c;
            EXPECT_LT(mean.error[c] / mean.value[c], 0.02);
        }
    }
}

struct Example {
    World world = bodyOf({{makeSphere(10, 30)}});
    Medium medium = subedit::mediumFromAlbedo({0.95, 0.9, 0.8}, {2.0, 1.5, 1.0}, kEta);
    glm::ivec2 size{12, 12};
    CameraView view = viewFromAbove(24, size);
    std::array<Light, 1> lights{directionalLight({0.5, -0.3, -1})};

    [[nodiscard]] PathTracedResult solve(PathTracedSettings settings,
                                         std::span<const Light> shining) const {
        settings.medium = medium;
        return PathTraced(world, settings).solve(view, size, shining);
    }
    [[nodiscard]] PathTracedResult solve(std::uint64_t paths, std::uint64_t seed) const {
        return solve({.paths = paths, .seed = seed}, lights);
    }
};

/// Sum of squared differences over the sum of squared standard errors of both: 1 expected.
double consistency(const PathTracedResult& a, const PathTracedResult& b) {
    double differences = 0;
    double errors = 0;
    for (std::size_t i = 0; i < a.exitance.size(); ++i) {
        const glm::dvec3 d(a.exitance[i] - b.exitance[i]);
        const glm::dvec3 ea(a.standardError[i]);
        const glm::dvec3 eb(b.standardError[i]);
        differences += glm::dot(d, d);
        errors += glm::dot(ea, ea) + glm::dot(eb, eb);
    }
    return differences / errors;
}

TEST(PathTraced, NoiseIsWhatTwoRunsDifferByAndHalvesWithFourTimesThePaths) {
    const Example scene;
    const PathTracedResult few = scene.solve(1 << 14, 1);
    const PathTracedResult fewAgain = scene.solve(1 << 14, 2);
    const PathTracedResult many = scene.solve(1 << 16, 3);
    // 432 values from 64 batches each, of which those of one pixel go together.
    EXPECT_NEAR(consistency(few, fewAgain), 1.0, 0.3);
    EXPECT_NEAR(consistency(few, many), 1.0, 0.3);
    EXPECT_NEAR(few.relativeError / many.relativeError, 2.0, 0.2);
    EXPECT_NE(few.exitance, fewAgain.exitance);
    EXPECT_EQ(few.exitance, scene.solve(1 << 14, 1).exitance);
}

TEST(PathTraced, StopsAtTheNoiseAskedFor) {
    const Example scene;
    const PathTracedResult result = scene.solve({.paths = 1 << 24, .noise = 0.1}, scene.lights);
    EXPECT_LE(result.relativeError, 0.1);
    EXPECT_LT(result.paths, 1u << 22);
}

TEST(PathTraced, LightsOfAllKindsBringTheFluxThatGeometryIntercepts) {
    const Example scene;
    Light spot = pointLight({0, 0, 40}, {2, 2, 2});
    spot.kind = Light::Kind::Spot;
    spot.direction = {0, 0, -1};
    spot.innerConeRadians = 0.1;
    spot.outerConeRadians = 0.101;
    // One body, and two with a light between them, within their bounding sphere.
    const World two = bodyOf({{makeSphere(4, 30, {9, 0, 0})}, {makeSphere(4, 30, {-9, 0, 0})}});
    const std::vector<std::pair<const World*, Light>> cases{
        {&scene.world, directionalLight({1, 2, -1}, {3, 3, 3})},
        {&scene.world, pointLight({0, 0, 25}, {5, 5, 5})},
        {&scene.world, spot},
        {&two, pointLight({0, 0, 0}, {5, 5, 5})}};
    for (const auto& [world, light] : cases) {
        const std::array lights{light};
        double expected = 0;
        for (const Patch& patch :
             SurfaceReference(*world).samplePatches(lights, 100000, 1).patches) {
            expected += patch.flux.x;
        }
        const RayScene rays(*world);
        const LightSource source(rays, lights, kEta);
        double entered = 0;
        constexpr int kSide = 150;
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::dvec2 place((i % kSide + 0.5) / kSide, (i / kSide + 0.5) / kSide);
            if (const auto entry = source.sample(0.5, place)) {
                entered += entry->flux.x / (kSide * kSide);
            }
        }
        EXPECT_NEAR(entered / expected, 1.0, 0.01);
    }
}

TEST(PathTraced, OverlappingBodiesAreOneAndOpaquePartsAbsorb) {
    Medium medium = subedit::mediumFromAlbedo({0.99, 0.99, 0.99}, {1.0, 1.0, 1.0}, kEta);
    const std::array lights{directionalLight({0, 0, -1})};
    const glm::ivec2 size(4, 4);
    const auto leftOf = [&](const World& world) {
        const PathTracedResult result = PathTraced(world, {.medium = medium, .paths = 60000})
                                            .solve(viewFromAbove(20, size), size, lights);
        EXPECT_LT(result.flux.lost.x / result.flux.entered.x, 1e-3);
        return result.flux.left.x;
    };
    const double whole = leftOf(bodyOf({{makeBox({20, 20, 8})}}));
    const double halves = leftOf(
        bodyOf({{makeBox({12, 20, 8}, {-4, 0, 0})}, {makeBox({12, 19.99, 7.99}, {4, 0, 0})}}));
    EXPECT_NEAR(halves / whole, 1.0, 0.02);
    const double cored = leftOf(bodyOf({{makeBox({20, 20, 8})}, {makeBox({18, 18, 2}), -1}}));
    EXPECT_LT(cored / whole, 0.9);
}

TEST(PathTraced, NoLightIsNoExitance) {
    const Example scene;
    const PathTracedResult result = scene.solve({.paths = 1000}, {});
    EXPECT_EQ(meanOf(result).value, glm::dvec3(0.0));
    EXPECT_EQ(result.relativeError, 0.0);
}

TEST(Refracted, FollowsSnell) {
    const glm::dvec3 normal(0, 0, 1);
    const glm::dvec3 toSource = glm::normalize(glm::dvec3(1, 0, 1));
    const glm::dvec3 inside = *refracted(toSource, normal, 1.5);
    EXPECT_NEAR(inside.x, -std::sqrt(0.5) / 1.5, 1e-12);
    EXPECT_LT(inside.z, 0.0);
    EXPECT_NEAR(glm::length(inside), 1.0, 1e-12);
    EXPECT_FALSE(refracted(toSource, normal, 1 / 1.5)); // beyond the critical angle
}

} // namespace
} // namespace celadon
