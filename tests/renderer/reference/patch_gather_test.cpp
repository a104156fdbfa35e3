#include "reference_support.h"
#include "renderer/reference/patch_gather.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
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
    std::printf("worst %g\n", worst);
}

TEST(PatchGather, SumOverASheetIsThatOfTheDefinition) {
    RandomScene scene = makeScene({makeHomogeneous({0.75, 0.6, 0.45}, 12)}, 96, 6, 20.0f);
    const GatherResult result = gatherExitance(scene.exits, scene.patches, scene.materials);
    for (std::size_t o = 0; o < scene.exits.size(); ++o) {
        glm::dvec3 sum(0);
        for (const Patch& patch : scene.patches) {
            const glm::dvec3 d =
                glm::dvec3(scene.exits[o].positionMm) - glm::dvec3(patch.positionMm);
            if (glm::length(d) > 2) {
                continue;
            }
            sum += footprintMean<200>(scene.exits[o], patch, scene.materials) *
                   glm::dvec3(patch.flux) * 1e6;
        }
        std::vector<Patch> near;
        for (const Patch& patch : scene.patches) {
            if (glm::length(glm::dvec3(scene.exits[o].positionMm) - glm::dvec3(patch.positionMm)) <=
                2) {
                near.push_back(patch);
            }
        }
        const GatherResult nearby =
            gatherExitance(std::span(scene.exits).subspan(o, 1), near, scene.materials);
        EXPECT_LT(relativeDifference(nearby.exitance[0], sum), 1e-4);
        std::printf("%g\n", relativeDifference(nearby.exitance[0], sum));
    }
}

TEST(PatchGather, DISABLED_Throughput) {
    RandomScene scene = makeScene({makeHomogeneous({0.75, 0.6, 0.45}, 12)}, 512, 4000);
    for (const bool portable : {false, true}) {
        for (const bool points : {true, false}) {
            const auto start = std::chrono::steady_clock::now();
            const GatherResult result =
                gatherExitance(scene.exits, scene.patches, scene.materials,
                               {.pointSamples = points, .forcePortable = portable});
            const double s =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            std::printf("portable %d points %d: %.0f M pairs, %.0f Mpairs/s\n", portable, points,
                        static_cast<double>(result.pairs) * 1e-6,
                        static_cast<double>(result.pairs) * 1e-6 / s);
        }
    }
}

} // namespace
} // namespace celadon
