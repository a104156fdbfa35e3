#include "reference_support.h"
#include "renderer/reference/error_metrics.h"
#include "renderer/reference/light_view.h"
#include "renderer/reference/surface_reference.h"
#include "renderer/shading/fresnel.h"

#include <gtest/gtest.h>

#include <array>

namespace celadon {
namespace {

using namespace celadon::testing;

glm::dvec3 totalFlux(const SurfacePatches& samples) {
    glm::dvec3 sum(0);
    for (const Patch& patch : samples.patches) {
        sum += glm::dvec3(patch.flux);
    }
    return sum;
}

TEST(SurfaceReference, UniformLightOnALargeSlabGivesAlbedoTimesTransmittedIrradiance) {
    const glm::dvec3 albedo(0.9, 0.7, 0.5);
    const glm::dvec3 irradiance(3, 2, 1);
    // The mesh's triangles are larger than a patch once, smaller once.
    for (const int cells : {4, 150}) {
        const World world =
            makeWorld({{makeSlab(60, cells)}}, {makeHomogeneous({1, 0.8, 0.6}, 20, albedo)});
        const SurfaceReference reference(world);
        const glm::dvec3 direction = glm::normalize(glm::dvec3(0.5, -0.3, -1));
        const std::array lights{directionalLight(direction, irradiance)};
        std::vector<ExitPoint> exits;
        for (int i = 0; i < 25; ++i) {
            exits.push_back(
                {{0.37f * static_cast<float>(i % 5), 0.41f * static_cast<float>(i / 5), 0},
                 {0.5f, 0.5f},
                 0});
        }
        const SurfaceReferenceResult result = reference.solve(exits, lights, {.samples = 40000});
        const double cosine = -direction.z;
        const glm::dvec3 expected =
            albedo * irradiance * cosine * fresnelTransmittance(cosine, 1.3);
        double worst = 0;
        for (const glm::vec3 exitance : result.exitance) {
            for (int c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(exitance[c] / expected[c] - 1.0));
            }
        }
        EXPECT_LT(worst, 0.005) << cells;
        std::printf("cells %d: worst %g, error %g\n", cells, worst, result.relativeError);
    }
}

TEST(SurfaceReference, FluxIsWhatTheGeometryIntercepts) {
    // A sphere intercepts pi R^2; its mesh a little less. F_t is taken out by an index of 1.
    const World world =
        makeWorld({{makeSphere(50, 64)}}, {makeHomogeneous({1, 1, 1}, 20, {0.9, 0.7, 0.5}, 1.0f)});
    const SurfaceReference reference(world);
    const double crossSection = std::numbers::pi * 50 * 50 * 1e-6;
    for (const int samples : {2000, 100000}) { // fewer and more than triangles
        const std::array lights{directionalLight({1, 2, -1}, {1, 2, 3})};
        const glm::dvec3 flux = totalFlux(reference.samplePatches(lights, samples, 3));
        EXPECT_NEAR(flux.x / crossSection, 1.0, samples < 10000 ? 2e-2 : 3e-3);
        EXPECT_NEAR(flux.y / flux.x, 2.0, 1e-5);
        EXPECT_NEAR(flux.z / flux.x, 3.0, 1e-5);
    }
    // A point light: the solid angle of the sphere times its intensity.
    const double distance = 150;
    const std::array lights{pointLight({0, distance, 0})};
    const double solidAngle =
        2 * std::numbers::pi * (1 - std::sqrt(1 - std::pow(50 / distance, 2)));
    EXPECT_NEAR(totalFlux(reference.samplePatches(lights, 100000, 3)).x / solidAngle, 1.0, 3e-3);
}

TEST(SurfaceReference, OpaquePartsShadowAndGiveNothing) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 1, 1}, 20)};
    const std::array lights{directionalLight({0, 0, -1})};
    const World open = makeWorld({{makeSlab(40, 2)}}, materials);
    // Half of the slab lies below an opaque one that has its back to the light.
    Mesh cover = makeSlab(40, 1, 5);
    for (glm::vec3& p : cover.positions) {
        p.x = -p.x + 20;
    }
    const World covered = makeWorld({{makeSlab(40, 2)}, {cover, -1}}, materials);
    const double all = totalFlux(SurfaceReference(open).samplePatches(lights, 5000, 1)).x;
    const SurfacePatches rest = SurfaceReference(covered).samplePatches(lights, 5000, 1);
    EXPECT_NEAR(totalFlux(rest).x / all, 0.5, 0.01);
    for (const Patch& patch : rest.patches) {
        EXPECT_LT(patch.positionMm.x, 1.0f);
        EXPECT_EQ(patch.positionMm.z, 0.0f);
    }
}

TEST(SurfaceReference, SurfaceThatTurnsItsBackTakesNothingUnlessDoubleSided) {
    World world = makeWorld({{makeSlab(40, 2)}}, {makeHomogeneous({1, 1, 1}, 20)});
    const std::array below{directionalLight({0, 0.5, 1})};
    EXPECT_TRUE(SurfaceReference(world).samplePatches(below, 100, 1).patches.empty());
    world.looks[0].doubleSided = true;
    const std::array above{directionalLight({0, 0.5, -1})};
    EXPECT_NEAR(totalFlux(SurfaceReference(world).samplePatches(below, 100, 1)).x,
                totalFlux(SurfaceReference(world).samplePatches(above, 100, 1)).x, 1e-9);
}

TEST(SurfaceReference, ShadingNormalMustFaceTheLightToo) {
    World world = makeWorld({{makeSlab(40, 2)}}, {makeHomogeneous({1, 1, 1}, 20)});
    for (glm::vec3& normal : world.meshes[0].mesh.normals) {
        normal = glm::normalize(glm::vec3(1, 0, 0.2f));
    }
    const std::array lights{directionalLight({1, 0, -0.5})};
    EXPECT_TRUE(SurfaceReference(world).samplePatches(lights, 100, 1).patches.empty());
}

TEST(SurfaceReference, LinearInTheLightsAndZeroWithoutThem) {
    const World world = makeWorld({{makeSphere(20, 24)}}, {makeHomogeneous({1, 0.8, 0.6}, 16)});
    const SurfaceReference reference(world);
    const std::vector<ExitPoint> exits = randomExitPoints(world, 50);
    const Light a = directionalLight({1, 0, -1}, {1, 2, 3});
    const Light b = pointLight({0, 60, 10}, {0.01, 0.01, 0.02});
    Light twiceA = a;
    twiceA.color *= 2;
    const SurfaceReferenceOptions options{.samples = 20000};
    const auto solve = [&](std::vector<Light> lights) {
        return reference.solve(exits, lights, options).exitance;
    };
    const std::vector<glm::vec3> fromA = solve({a});
    const std::vector<glm::vec3> fromB = solve({b});
    const std::vector<glm::vec3> fromBoth = solve({a, b});
    const std::vector<glm::vec3> fromTwice = solve({twiceA});
    std::vector<glm::vec3> sum(exits.size());
    std::vector<glm::vec3> twice(exits.size());
    for (std::size_t i = 0; i < exits.size(); ++i) {
        sum[i] = fromA[i] + fromB[i];
        twice[i] = 2.0f * fromA[i];
    }
    EXPECT_LT(compareExitance(fromBoth, sum).relativeRmse, 1e-5);
    EXPECT_LT(compareExitance(fromTwice, twice).relativeRmse, 1e-6);
    for (const glm::vec3 exitance : solve({})) {
        EXPECT_EQ(exitance, glm::vec3(0));
    }
}

TEST(SurfaceReference, ErrorFallsAsSamplesDouble) {
    const World world =
        makeWorld({{makeBentPlate(20, 50, 24)}}, {makeHomogeneous({0.6, 0.5, 0.4}, 11)});
    const SurfaceReference reference(world);
    const std::vector<ExitPoint> exits = randomExitPoints(world, 300);
    const std::array lights{directionalLight({-1, -0.4, 0.3})}; // shadows itself
    const SurfaceReferenceResult truth =
        reference.solve(exits, lights, {.samples = 400000, .seed = 99});
    std::vector<double> errors;
    for (int samples = 4000; samples <= 64000; samples *= 2) {
        const SurfaceReferenceResult result = reference.solve(exits, lights, {.samples = samples});
        const double error = compareExitance(result.exitance, truth.exitance).relativeRmse;
        std::printf("%d samples: error %.4f %%, estimate %.4f %%, %g M pairs\n", samples,
                    100 * error, 100 * result.relativeError,
                    1e-6 * static_cast<double>(result.pairs));
        errors.push_back(error);
        // The estimate is honest: neither a tenth nor ten times of what it estimates.
        EXPECT_GT(result.relativeError, 0.3 * error) << samples;
        EXPECT_LT(result.relativeError, 3.0 * error) << samples;
    }
    // Cells with one place each converge at least as 1/N^(3/4) at a shadow's border, faster
    // elsewhere; four doublings make a factor of 8.
    EXPECT_LT(errors.back(), errors.front() / 8);
    EXPECT_LT(errors.back(), 0.01);
}

struct Comparison {
    ErrorMetrics image;
    ErrorMetrics points;
    double noise;
};

Comparison compareImageWithSurface(const World& world, const Light& light, int size) {
    const SurfaceReference reference(world);
    const std::vector<ExitPoint> exits = randomExitPoints(world, 500);
    const std::array lights{light};
    const SurfaceReferenceResult truth = reference.solve(exits, lights, {.samples = 300000});
    const std::vector<Patch> patches = lightViewPatches(reference.rays(), light, size);
    const GatherResult image = gatherExitance(exits, patches, world.materials);
    const GatherResult points =
        gatherExitance(exits, patches, world.materials, {.pointSamples = true});
    Comparison comparison{compareExitance(image.exitance, truth.exitance),
                          compareExitance(points.exitance, truth.exitance), truth.relativeError};
    std::printf("image %.3f %% ratio %.5f, points %.3f %% ratio %.5f, noise %.3f %%\n",
                100 * comparison.image.relativeRmse, comparison.image.meanRatio,
                100 * comparison.points.relativeRmse, comparison.points.meanRatio,
                100 * truth.relativeError);
    return comparison;
}

TEST(ImageAgainstSurface, AgreeOnASphere) {
    // R_P is 5 % of the diameter.
    const World world = makeWorld({{makeSphere(50, 48)}}, {makeHomogeneous({0.62, 0.5, 0.37}, 12)});
    const Comparison directional =
        compareImageWithSurface(world, directionalLight({-1, 0.5, -0.3}), 512);
    EXPECT_LT(directional.image.relativeRmse, 0.006);
    EXPECT_NEAR(directional.image.meanRatio, 1.0, 0.003);
    EXPECT_GT(directional.points.relativeRmse, directional.image.relativeRmse);
    const Comparison point = compareImageWithSurface(world, pointLight({20, -110, 30}), 512);
    EXPECT_LT(point.image.relativeRmse, 0.006);
    EXPECT_NEAR(point.image.meanRatio, 1.0, 0.003);
}

TEST(ImageAgainstSurface, AgreeOnABentPlateThatShadowsItself) {
    const World world =
        makeWorld({{makeBentPlate(30, 80, 40)}}, {makeHomogeneous({0.62, 0.5, 0.37}, 12)});
    const Comparison directional =
        compareImageWithSurface(world, directionalLight({-1, -0.4, 0.3}), 512);
    EXPECT_LT(directional.image.relativeRmse, 0.01);
    EXPECT_NEAR(directional.image.meanRatio, 1.0, 0.003);
    // A light within the tube's bounding sphere: six faces.
    World inside = world;
    inside.looks[0].doubleSided = true;
    const Comparison cube = compareImageWithSurface(inside, pointLight({3, 2, 5}), 256);
    EXPECT_LT(cube.image.relativeRmse, 0.01);
    EXPECT_NEAR(cube.image.meanRatio, 1.0, 0.003);
}

} // namespace
} // namespace celadon
