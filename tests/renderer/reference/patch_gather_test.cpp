#include "reference_support.h"
#include "renderer/reference/patch_gather.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <iterator>
#include <random>

namespace celadon {
namespace {

using testing::makeHomogeneous;
using testing::makeMaterial;

/// sqrt(P_i P_o) at distance t, straight from the maps, in double.
glm::dvec3 kernelAt(double t, const subedit::MaterialMap& a, glm::vec2 uvA,
                    const subedit::MaterialMap& b, glm::vec2 uvB) {
    if (t > a.maxRadiusMm || t > b.maxRadiusMm) {
        return glm::dvec3(0);
    }
    const auto logAt = [&](const subedit::MaterialMap& map, glm::vec2 uv) {
        std::vector<float> knots(map.knots() * 3);
        map.sampleLogProfile(uv, knots.data());
        const double position = t * map.segments / map.maxRadiusMm;
        const int k = std::min(static_cast<int>(position), map.segments - 1);
        glm::dvec3 value;
        for (int c = 0; c < 3; ++c) {
            value[c] = knots[3 * k + c] +
                       (position - k) * (double(knots[3 * k + 3 + c]) - knots[3 * k + c]);
        }
        return value;
    };
    return glm::exp(0.5 * (logAt(a, uvA) + logAt(b, uvB)));
}

/// The footprint's mean as it is defined: over a disc in the plane, by many rings.
template<int kRings = 1000>
glm::dvec3 footprintMean(const ExitPoint& exit, const Patch& patch,
                         std::span<const MaterialPointer> materials) {
    const glm::dvec3 delta = glm::dvec3(exit.positionMm) - glm::dvec3(patch.positionMm);
    const auto& c = patch.covariance;
    const glm::dmat3 C(c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5]);
    const double variance = c[0] + c[3] + c[5];
    const double d2 = glm::dot(delta, delta);
    const double q =
        d2 > 0 ? std::min(2 * glm::dot(delta, C * delta) / d2, 1.3 * variance) : variance;
    const double center = std::sqrt(d2 + variance - q);
    const double radius = std::sqrt(2 * q);
    if (radius == 0) {
        return kernelAt(center, *materials[patch.material], patch.uv, *materials[exit.material],
                        exit.uv);
    }
    // Rings about the exit point, each with the part of it that lies in the disc, found by
    // bisection: the distance from the disc's center grows with the angle.
    const double low = std::max(center - radius, 0.0);
    const double width = (center + radius - low) / kRings;
    glm::dvec3 sum(0);
    double area = 0;
    for (int i = 0; i < kRings; ++i) {
        const double t = low + (i + 0.5) * width;
        double inside = 0;
        double outside = std::numbers::pi;
        if (t + center <= radius) {
            inside = outside;
        }
        for (int step = 0; step < 30 && inside < outside; ++step) {
            const double angle = 0.5 * (inside + outside);
            const double squared = t * t + center * center - 2 * t * center * std::cos(angle);
            (squared <= radius * radius ? inside : outside) = angle;
        }
        sum +=
            inside * t *
            kernelAt(t, *materials[patch.material], patch.uv, *materials[exit.material], exit.uv);
        area += inside * t;
    }
    return sum / area;
}

double relativeDifference(glm::dvec3 a, glm::dvec3 b) {
    return glm::length(a - b) / glm::length(b);
}

Patch patchAt(glm::vec3 position, int material = 0, glm::vec2 uv = {0.5f, 0.5f}) {
    Patch patch;
    patch.positionMm = position;
    patch.flux = glm::vec3(1e-6f); // W: one W/m^2 on a square millimeter
    patch.material = material;
    patch.uv = uv;
    return patch;
}

ExitPoint exitAt(glm::vec3 position, int material = 0, glm::vec2 uv = {0.5f, 0.5f}) {
    return {position, uv, material};
}

struct RandomScene {
    std::vector<MaterialPointer> materials;
    std::vector<Patch> patches;
    std::vector<ExitPoint> exits;
};

/// A bumpy sheet of texel patches 100 mm wide, and exit points on it.
RandomScene makeScene(std::vector<MaterialPointer> materials, int size, int exits,
                      float widthMm = 100.0f, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    RandomScene scene;
    scene.materials = std::move(materials);
    const auto count = static_cast<int>(scene.materials.size());
    const auto height = [](glm::vec2 p) {
        return 4 * std::sin(0.2f * p.x) * std::cos(0.15f * p.y);
    };
    const auto normal = [&](glm::vec2 p) {
        const float e = 1e-2f;
        return glm::normalize(
            glm::vec3(-(height(p + glm::vec2(e, 0)) - height(p - glm::vec2(e, 0))) / (2 * e),
                      -(height(p + glm::vec2(0, e)) - height(p - glm::vec2(0, e))) / (2 * e), 1));
    };
    const float texel = widthMm / static_cast<float>(size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 p = texel * (glm::vec2(x, y) + 0.5f);
            const glm::vec3 n = normal(p);
            const glm::vec3 flux(texel * texel * 1e-6f * (0.5f + uniform(random)));
            scene.patches.push_back(makeTexelPatch({p, height(p)}, n, flux, texel * texel, n.z,
                                                   p / widthMm, (x * 3 / size + y) % count));
        }
    }
    for (int i = 0; i < exits; ++i) {
        const glm::vec2 p = widthMm * glm::vec2(uniform(random), uniform(random));
        scene.exits.push_back(exitAt({p, height(p)}, i % count, p / widthMm));
    }
    return scene;
}

TEST(PatchGather, OnePairIsTheGeometricMeanOfBothProfiles) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 0.8, 0.5}, 20),
                                                 makeHomogeneous({2, 1, 0.5}, 30, {0.5, 0.9, 0.2})};
    const std::vector<Patch> patches{patchAt({1, 2, 3}, 0)};
    for (const float d : {0.0f, 1e-4f, 0.3f, 0.625f, 4.0f, 17.0f, 19.99f}) {
        const std::vector<ExitPoint> exits{exitAt({1, 2 + d, 3}, 1)};
        const glm::dvec3 expected =
            kernelAt(double(exits[0].positionMm.y) - 2, *materials[0], {}, *materials[1], {});
        const GatherResult result =
            gatherExitance(exits, patches, materials, {.pointSamples = true});
        EXPECT_LT(relativeDifference(result.exitance[0], expected), 1e-5) << d;
        EXPECT_EQ(result.pairs, 1u);
        // A patch without extent is a point for the footprint kernel too.
        const GatherResult blurred = gatherExitance(exits, patches, materials);
        EXPECT_LT(relativeDifference(blurred.exitance[0], expected), 1e-5) << d;
    }
}

TEST(PatchGather, NothingPassesBeyondEitherRadius) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 1, 1}, 20),
                                                 makeHomogeneous({1, 1, 1}, 12)};
    const std::vector<Patch> patches{patchAt({0, 0, 0}, 0)};
    for (const bool points : {false, true}) {
        const std::vector<ExitPoint> exits{exitAt({12.01f, 0, 0}, 1), exitAt({12.01f, 0, 0}, 0),
                                           exitAt({0, 20.01f, 0}, 0), exitAt({0, 0, 0}, -1)};
        const GatherResult result =
            gatherExitance(exits, patches, materials, {.pointSamples = points});
        EXPECT_EQ(result.exitance[0], glm::vec3(0));
        EXPECT_GT(result.exitance[1].x, 0);
        EXPECT_EQ(result.exitance[2], glm::vec3(0));
        EXPECT_EQ(result.exitance[3], glm::vec3(0)) << "background";
        EXPECT_EQ(result.pairs, 1u);
    }
}

TEST(PatchGather, FootprintIsTheMeanOverItsDisc) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 0.6, 0.3}, 20)};
    double worst = 0;
    for (const float spacing :
         {0.05f, 0.2f, 0.8f, 3.0f}) { // from a fine texel to a very coarse one
        for (const float cosine : {1.0f, 0.3f}) {
            for (const float tilt : {0.0f, 0.7f, 1.5708f}) { // of the pair out of the patch's plane
                for (const float distance : {0.0f, 0.02f, 0.1f, 0.3f, 1.0f, 3.0f, 9.0f, 18.0f}) {
                    Patch patch = makeTexelPatch({}, {0, 0, 1}, glm::vec3(1e-6f), spacing * spacing,
                                                 cosine, {}, 0);
                    const std::vector<ExitPoint> exits{
                        exitAt(distance * glm::vec3(std::cos(tilt), 0, std::sin(tilt)))};
                    const GatherResult result =
                        gatherExitance(exits, std::vector{patch}, materials);
                    const glm::dvec3 expected = footprintMean(exits[0], patch, materials);
                    const double error = relativeDifference(result.exitance[0], expected);
                    EXPECT_LT(error, 1e-3)
                        << spacing << ' ' << cosine << ' ' << tilt << ' ' << distance;
                    worst = std::max(worst, error);
                }
            }
        }
    }
    RecordProperty("worst", std::to_string(worst));
}

TEST(PatchGather, SumOverASheetIsThatOfTheDefinition) {
    const RandomScene scene = makeScene({makeHomogeneous({0.75, 0.6, 0.45}, 12)}, 96, 4, 20.0f);
    for (const ExitPoint& exit : scene.exits) {
        // The nearest, where the kernel varies most; the rest is the same formula again.
        std::vector<Patch> near;
        std::ranges::copy_if(scene.patches, std::back_inserter(near), [&](const Patch& patch) {
            return glm::distance(exit.positionMm, patch.positionMm) <= 2;
        });
        glm::dvec3 sum(0);
        for (const Patch& patch : near) {
            sum += footprintMean<200>(exit, patch, scene.materials) * glm::dvec3(patch.flux) * 1e6;
        }
        const GatherResult result = gatherExitance(std::span(&exit, 1), near, scene.materials);
        EXPECT_LT(relativeDifference(result.exitance[0], sum), 1e-4);
    }
}

TEST(PatchGather, TriangleIsIntegratedAsSuchByPointsNearIt) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 0.6, 0.3}, 20)};
    const PatchTriangle corners{glm::vec3(0, 0, 0), glm::vec3(1.2f, 0.1f, 0),
                                glm::vec3(0.3f, 0.5f, 0.4f)};
    Patch patch = patchAt((corners[0] + corners[1] + corners[2]) / 3.0f);
    for (const glm::vec3& corner : corners) {
        const glm::vec3 d = corner - patch.positionMm;
        const std::array<float, 6> products{d.x * d.x, d.x * d.y, d.x * d.z,
                                            d.y * d.y, d.y * d.z, d.z * d.z};
        for (std::size_t i = 0; i < 6; ++i) {
            patch.covariance[i] += products[i] / 12;
        }
    }
    const std::vector<PatchTriangle> triangles{corners};
    // Within, on a corner, beside, above, just past where it counts as far, far.
    for (const glm::vec3& at :
         {patch.positionMm, corners[1], glm::vec3(-0.3f, 0.2f, 0), glm::vec3(0.5f, 0.1f, 0.6f),
          glm::vec3(3.8f, 1, 0), glm::vec3(1, 9, 2)}) {
        const std::vector<ExitPoint> exits{exitAt(at)};
        glm::dvec3 sum(0);
        constexpr int kCuts = 200; // kCuts^2 equal parts, each by its center
        for (int i = 0; i < kCuts; ++i) {
            for (int j = 0; j < 2 * (kCuts - i) - 1; ++j) {
                const double shift = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
                const double u = (i + shift) / kCuts;
                const double v = (j / 2 + shift) / kCuts;
                const glm::dvec3 y = (1 - u - v) * glm::dvec3(corners[0]) +
                                     u * glm::dvec3(corners[1]) + v * glm::dvec3(corners[2]);
                sum +=
                    kernelAt(glm::length(y - glm::dvec3(at)), *materials[0], {}, *materials[0], {});
            }
        }
        const GatherResult result =
            gatherExitance(exits, std::vector{patch}, materials, {.triangles = triangles});
        // Far away a triangle is its covariance; its skewness is what is left, 1e-3 at worst.
        EXPECT_LT(relativeDifference(result.exitance[0], sum / double(kCuts * kCuts)), 1.5e-3)
            << at.x;
    }
}

TEST(PatchGather, KernelIsSymmetric) {
    const std::vector<MaterialPointer> materials{
        makeMaterial(4, 15, 20,
                     [](int x, int y) {
                         return std::pair(glm::dvec3(0.2 + 0.15 * x, 0.9, 0.5),
                                          glm::dvec3(0.5 + 0.1 * y, 0.7, 0.2 + 0.2 * x));
                     }),
        makeHomogeneous({1, 1, 0.5}, 20)};
    const glm::vec3 a(1, 2, 3);
    const glm::vec3 b(-2, 4, 3.5f);
    const glm::vec2 uvA(0.31f, 0.77f);
    const glm::vec2 uvB(0.05f, 0.6f);
    const std::vector<Patch> atA{patchAt(a, 0, uvA)};
    const std::vector<Patch> atB{patchAt(b, 1, uvB)};
    const std::vector<ExitPoint> fromA{exitAt(a, 0, uvA)};
    const std::vector<ExitPoint> fromB{exitAt(b, 1, uvB)};
    const glm::vec3 forth = gatherExitance(fromB, atA, materials).exitance[0];
    const glm::vec3 back = gatherExitance(fromA, atB, materials).exitance[0];
    EXPECT_GT(forth.x, 0);
    EXPECT_LT(relativeDifference(forth, back), 1e-6);
}

TEST(PatchGather, LinearInTheFlux) {
    const RandomScene scene = makeScene({makeHomogeneous({0.75, 0.6, 0.45}, 12)}, 64, 20);
    std::vector<Patch> twice = scene.patches;
    std::vector<Patch> none = scene.patches;
    for (std::size_t i = 0; i < twice.size(); ++i) {
        twice[i].flux *= 2.0f;
        none[i].flux = glm::vec3(0);
    }
    const GatherResult one = gatherExitance(scene.exits, scene.patches, scene.materials);
    const GatherResult two = gatherExitance(scene.exits, twice, scene.materials);
    const GatherResult zero = gatherExitance(scene.exits, none, scene.materials);
    for (std::size_t i = 0; i < scene.exits.size(); ++i) {
        EXPECT_GT(one.exitance[i].x, 0);
        EXPECT_LT(relativeDifference(two.exitance[i], glm::dvec3(one.exitance[i]) * 2.0), 1e-6);
        EXPECT_EQ(zero.exitance[i], glm::vec3(0));
    }
    EXPECT_EQ(zero.pairs, 0u);
}

std::vector<MaterialPointer> variedMaterials() {
    const auto cells = [](int x, int y) {
        return std::pair(glm::dvec3(0.9, 0.3 + 0.05 * x, 0.5),
                         glm::dvec3(0.4 + 0.1 * ((x + y) % 2), 0.5, 0.3 + 0.02 * y));
    };
    return {makeHomogeneous({0.75, 0.6, 0.45}, 12), makeMaterial(8, 10, 24, cells),
            makeMaterial(3, 14, 1, cells)};
}

TEST(PatchGather, InstructionSetsAgree) {
    const RandomScene scene = makeScene(variedMaterials(), 96, 60);
    for (const bool points : {true, false}) {
        const GatherResult chosen =
            gatherExitance(scene.exits, scene.patches, scene.materials, {.pointSamples = points});
        const GatherResult portable =
            gatherExitance(scene.exits, scene.patches, scene.materials,
                           {.pointSamples = points, .forcePortable = true});
        for (std::size_t i = 0; i < scene.exits.size(); ++i) {
            EXPECT_LT(relativeDifference(chosen.exitance[i], portable.exitance[i]), 1e-5);
        }
        // A pair at the very rim may round either way.
        EXPECT_NEAR(static_cast<double>(chosen.pairs), static_cast<double>(portable.pairs), 3);
    }
}

TEST(PatchGather, PointSumIsThatOfTheFormulaForVariedMaterials) {
    const RandomScene scene = makeScene(variedMaterials(), 48, 12, 40.0f);
    const GatherResult result =
        gatherExitance(scene.exits, scene.patches, scene.materials, {.pointSamples = true});
    std::uint64_t pairs = 0;
    for (std::size_t o = 0; o < scene.exits.size(); ++o) {
        const ExitPoint& exit = scene.exits[o];
        glm::dvec3 sum(0);
        for (const Patch& patch : scene.patches) {
            const double d =
                glm::distance(glm::dvec3(exit.positionMm), glm::dvec3(patch.positionMm));
            const glm::dvec3 kernel = kernelAt(d, *scene.materials[patch.material], patch.uv,
                                               *scene.materials[exit.material], exit.uv);
            sum += kernel * glm::dvec3(patch.flux) * 1e6;
            pairs += kernel.x > 0 ? 1 : 0;
        }
        EXPECT_LT(relativeDifference(result.exitance[o], sum), 1e-5);
    }
    EXPECT_NEAR(static_cast<double>(result.pairs), static_cast<double>(pairs), 3);
}

TEST(PatchGather, DoesNotDependOnTheOtherPointsNorOnTheOrderOfPatches) {
    RandomScene scene = makeScene(variedMaterials(), 64, 1200);
    const GatherResult together = gatherExitance(scene.exits, scene.patches, scene.materials);
    std::mt19937 random(3);
    for (const std::size_t i : {0u, 511u, 512u, 1199u}) {
        const GatherResult alone =
            gatherExitance(std::span(scene.exits).subspan(i, 1), scene.patches, scene.materials);
        EXPECT_EQ(alone.exitance[0], together.exitance[i]);
    }
    std::ranges::shuffle(scene.patches, random);
    const GatherResult shuffled = gatherExitance(scene.exits, scene.patches, scene.materials);
    for (std::size_t i = 0; i < scene.exits.size(); ++i) {
        EXPECT_LT(relativeDifference(shuffled.exitance[i], together.exitance[i]), 1e-6);
    }
}

TEST(PatchGather, BorderOfTwoMaterialsFollowsTheGeometricMean) {
    // A flat sheet, lit evenly on its left half only, of one material on the left and another on
    // the right: what comes out on the right is the integral of sqrt(P P) over the left half.
    const std::vector<MaterialPointer> materials{makeHomogeneous({0.8, 0.8, 0.8}, 15),
                                                 makeHomogeneous({0.3, 0.6, 1.2}, 15)};
    const float cell = 0.1f;
    std::vector<Patch> patches;
    for (int y = -160; y < 160; ++y) {
        for (int x = -160; x < 0; ++x) {
            patches.push_back(makeTexelPatch(
                cell * glm::vec3(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 0),
                {0, 0, 1}, glm::vec3(cell * cell * 1e-6f), cell * cell, 1, {}, 0));
        }
    }
    for (const double distance : {0.5, 2.0, 6.0}) {
        const std::vector<ExitPoint> exits{exitAt({distance, 0, 0}, 1)};
        // In rings about the point; 2 acos(distance / r) of each lies on the left.
        glm::dvec3 expected(0);
        constexpr int kRings = 20000;
        for (int i = 0; i < kRings; ++i) {
            const double r = distance + (15 - distance) * (i + 0.5) / kRings;
            expected += kernelAt(r, *materials[0], {}, *materials[1], {}) * r * 2.0 *
                        std::acos(distance / r) * (15 - distance) / double(kRings);
        }
        const GatherResult result = gatherExitance(exits, patches, materials);
        EXPECT_LT(relativeDifference(result.exitance[0], expected), 1e-3) << distance;
    }
}

TEST(PatchGather, FootprintsKeepEnergyWherePointsLoseIt) {
    // Coarse patches on a plane, as wide as R_P of the shortest channel; mean over exit points.
    const glm::dvec3 albedo(0.9, 0.7, 0.5);
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 0.5, 0.15}, 18, albedo)};
    std::vector<Patch> patches;
    for (int y = -20; y <= 20; ++y) {
        for (int x = -20; x <= 20; ++x) {
            patches.push_back(
                makeTexelPatch(glm::vec3(x, y, 0), {0, 0, 1}, glm::vec3(1e-6f), 1, 1, {}, 0));
        }
    }
    std::vector<ExitPoint> exits;
    for (int i = 0; i < 400; ++i) {
        exits.push_back(exitAt({static_cast<float>(i % 20) / 20 + 0.025f,
                                static_cast<float>(i / 20) / 20 + 0.025f, 0}));
    }
    const auto meanError = [&](bool points) {
        const GatherResult result =
            gatherExitance(exits, patches, materials, {.pointSamples = points});
        glm::dvec3 sum(0);
        for (const glm::vec3 exitance : result.exitance) {
            sum += glm::dvec3(exitance) / 400.0;
        }
        return glm::abs(sum / albedo - 1.0);
    };
    const glm::dvec3 blurred = meanError(false);
    EXPECT_LT(std::max({blurred.x, blurred.y, blurred.z}), 0.003);
}

TEST(PatchGather, NothingInNothingOut) {
    const std::vector<MaterialPointer> materials{makeHomogeneous({1, 1, 1}, 20)};
    EXPECT_TRUE(gatherExitance({}, {}, materials).exitance.empty());
    const std::vector<ExitPoint> exits{exitAt({0, 0, 0})};
    EXPECT_EQ(gatherExitance(exits, {}, materials).exitance[0], glm::vec3(0));
    EXPECT_TRUE(gatherExitance({}, std::vector{patchAt({0, 0, 0})}, materials).exitance.empty());
}

/// Pairs a second of processor time of each kernel: run with --gtest_also_run_disabled_tests.
TEST(PatchGather, DISABLED_Throughput) {
    const RandomScene scene = makeScene({makeHomogeneous({0.75, 0.6, 0.45}, 12)}, 512, 6000);
    const auto size = [](int, int) {
        return std::pair(glm::dvec3(0.5), glm::dvec3(0.75, 0.6, 0.45));
    };
    const std::vector<MaterialPointer> map{makeMaterial(64, 12, 32, size)};
    for (const auto& materials : {scene.materials, map}) {
        for (const bool portable : {false, true}) {
            for (const bool points : {true, false}) {
                const std::clock_t start = std::clock();
                const GatherResult result =
                    gatherExitance(scene.exits, scene.patches, materials,
                                   {.pointSamples = points, .forcePortable = portable});
                const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
                const double millions = static_cast<double>(result.pairs) * 1e-6;
                std::printf("%s, %s, %s: %.0f M pairs, %.0f M/s\n",
                            materials[0]->isHomogeneous() ? "homogeneous" : "map",
                            portable ? "portable" : "AVX2", points ? "points" : "footprints",
                            millions, millions / seconds);
            }
        }
    }
}

} // namespace
} // namespace celadon
