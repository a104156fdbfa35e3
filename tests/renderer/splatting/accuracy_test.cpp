// Splatting against the image reference (eq. 5 by brute force over the same light view): what the
// coarse samples, the coarse rings and the cut cost.
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

namespace celadon {
namespace {

#ifdef CELADON_FULL_ACCURACY // with real models, minutes long
constexpr glm::ivec2 kPicture(160, 120);
constexpr int kIrradianceSize = 256;
#else
constexpr glm::ivec2 kPicture(128, 96);
constexpr int kIrradianceSize = 256;
#endif

struct AccuracyCase {
    const char* name;
    const char* model;
    const char* material;
    double rmse = test::kSplattingRmse;
};

class Accuracy : public test::GlTest,
                 public testing::WithParamInterface<std::tuple<Scheme, AccuracyCase>> {};

TEST_P(Accuracy, SplattingIsTheImageReference) {
    const auto& [scheme, given] = GetParam();
    if (!test::isAvailable(given.model)) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const World world = test::makeWorld(given.model, test::materialNamed(given.material));
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::array lights{test::frontLight()};
    FrameSettings settings = test::smallFrame(kPicture, kIrradianceSize, scheme);
    const FloatImage image = test::renderFrame(context(), world, settings, camera, lights).image;
    settings.solver = SolverKind::ImageReference;
    const FloatImage reference =
        test::renderFrame(context(), world, settings, camera, lights).image;
    ASSERT_FALSE(findNonFinite(image).has_value());
    ASSERT_FALSE(findNonFinite(reference).has_value());
    const ValueErrors errors = test::compareExitance(image, reference);
    fmt::print("[ measured ] {} {}: relative RMSE {:.5f}, mean ratio {:.5f}\n",
               test::schemeWord(scheme), given.name, errors.relativeRmse, errors.meanRatio);
    EXPECT_LT(errors.relativeRmse, given.rmse);
    EXPECT_NEAR(errors.meanRatio, 1.0, test::kSplattingMean);
}

/// Of pixels beside one where nothing scatters or where the surface jumps away.
ValueErrors errorsAtRims(const FloatImage& image, const FloatImage& reference, double jumpMm) {
    FloatImage rims[2];
    for (FloatImage& row : rims) {
        row.height = 1;
        row.channels = {"R", "G", "B"};
    }
    const int position = reference.channelIndex("position.X");
    const auto placeAt = [&](int x, int y) {
        return glm::dvec3(reference.at(x, y, position), reference.at(x, y, position + 1),
                          reference.at(x, y, position + 2));
    };
    for (int y = 1; y + 1 < reference.height; ++y) {
        for (int x = 1; x + 1 < reference.width; ++x) {
            bool isRim = false;
            for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                isRim = isRim || !test::seesScattering(reference, glm::ivec2(x, y) + step) ||
                        glm::distance(placeAt(x, y), placeAt(x + step.x, y + step.y)) > jumpMm;
            }
            if (!isRim || !test::seesScattering(reference, {x, y})) {
                continue;
            }
            for (int k = 0; k < 2; ++k) {
                const glm::dvec3 value = test::exitanceAt(k == 0 ? image : reference, {x, y});
                for (int c = 0; c < 3; ++c) {
                    rims[k].pixels.push_back(static_cast<float>(value[c]));
                }
                ++rims[k].width;
            }
        }
    }
    return compareValues(rims[0], rims[1]);
}

using Silhouettes = test::GlTest;

TEST_F(Silhouettes, FarLightFallsOffAlongWhatCurvesAway) {
    // Nothing lies beyond a rim to interpolate with; the nearest coarse pixels alone are too
    // bright.
    constexpr glm::ivec2 kLarge(400, 300);
    const World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    const Camera camera = test::defaultCamera(world, kLarge);
    const std::array lights{test::directionalLight({-0.4, -0.5, -0.77})};
    FrameSettings settings = test::smallFrame(kLarge, 256, Scheme::Hierarchical);
    const FloatImage image = test::renderFrame(context(), world, settings, camera, lights).image;
    settings.solver = SolverKind::ImageReference;
    const FloatImage reference =
        test::renderFrame(context(), world, settings, camera, lights).image;
    const ValueErrors errors = errorsAtRims(image, reference, 3.0);
    fmt::print("[ measured ] rim of a sphere: relative RMSE {:.5f}, mean ratio {:.5f}\n",
               errors.relativeRmse, errors.meanRatio);
    EXPECT_LT(errors.relativeRmse, 0.04);
    EXPECT_NEAR(errors.meanRatio, 1.0, 0.016);
}

TEST_F(Silhouettes, LightEndsWithoutRings) {
    // Where light grazes, texels lie far apart up the slope: patches that do not reach their
    // neighbors leave rings, which the integral over the surface does not have.
    const World world = test::makeWorld("builtin:sphere", test::shortRangeMaterial());
    Camera camera = test::defaultCamera(world, kPicture);
    camera.eye = {0.0, 250.0, 0.01};
    const std::array lights{test::directionalLight({0.0, -0.2, 1.0})};
    FrameSettings settings = test::smallFrame(kPicture, 512, Scheme::Hierarchical);
    const FloatImage image = test::renderFrame(context(), world, settings, camera, lights).image;
    settings.solver = SolverKind::SurfaceReference;
    const FloatImage reference =
        test::renderFrame(context(), world, settings, camera, lights).image;
    const ValueErrors errors = test::compareExitance(image, reference);
    fmt::print("[ measured ] where light ends on a sphere: relative RMSE {:.5f}, max {:.5f}\n",
               errors.relativeRmse, errors.max);
    EXPECT_LT(errors.relativeRmse, 0.006); // discs of the strip's own area: 0.0081
}

TEST_F(Silhouettes, ObjectsFarBelowTheirRangesAreLit) {
    // Ranges that differ by many times the object's size must not keep neighbors apart.
    const World world =
        resized(test::makeWorld("builtin:sphere", test::chessboardMaterial()), 0.005);
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::array lights{test::frontLight()};
    for (const Scheme scheme : {Scheme::Hierarchical, Scheme::Paper}) {
        FrameSettings settings = test::smallFrame(kPicture, 128, scheme);
        const FloatImage image =
            test::renderFrame(context(), world, settings, camera, lights).image;
        settings.solver = SolverKind::ImageReference;
        const FloatImage reference =
            test::renderFrame(context(), world, settings, camera, lights).image;
        const ValueErrors errors = test::compareExitance(image, reference);
        fmt::print("[ measured ] {} on 0.5 mm: relative RMSE {:.5f}, mean ratio {:.5f}\n",
                   test::schemeWord(scheme), errors.relativeRmse, errors.meanRatio);
        EXPECT_LT(errors.relativeRmse, 0.12);
        EXPECT_NEAR(errors.meanRatio, 1.0, 0.02);
    }
}

constexpr AccuracyCase kCases[] = {
    {"SphereShort", "builtin:sphere", "short", test::kSplattingShortRmse},
    {"SphereMedium", "builtin:sphere", "medium"},
    {"SphereLong", "builtin:sphere", "long"},
    {"SphereChessboard", "builtin:sphere", "chessboard"},
    {"VaseShort", "builtin:vase", "short", test::kSplattingShortRmse},
    {"VaseMedium", "builtin:vase", "medium"},
    {"VaseLong", "builtin:vase", "long"},
    {"VaseChessboard", "builtin:vase", "chessboard"},
#ifdef CELADON_FULL_ACCURACY
    {"SpotMedium", "mesh/spot_uv.obj", "medium"},
    {"SpotLong", "mesh/spot_uv.obj", "long"},
    {"SpotChessboard", "mesh/spot_uv.obj", "chessboard"},
    {"BunnyMedium", "mesh/bunny_watertight_60k.obj", "medium"},
    {"BunnyLong", "mesh/bunny_watertight_60k.obj", "long"},
    {"BunnyChessboard", "mesh/bunny_watertight_60k.obj", "chessboard"},
    {"BuddhaMedium", "mesh/happy_buddha_100k.obj", "medium"},
    {"BuddhaLong", "mesh/happy_buddha_100k.obj", "long"},
    {"BuddhaChessboard", "mesh/happy_buddha_100k.obj", "chessboard"},
#endif
};

std::string caseName(const testing::TestParamInfo<std::tuple<Scheme, AccuracyCase>>& instance) {
    return std::string(std::get<1>(instance.param).name) + "_" +
           test::schemeWord(std::get<0>(instance.param));
}

INSTANTIATE_TEST_SUITE_P(Shapes, Accuracy,
                         testing::Combine(testing::ValuesIn(test::kSchemes),
                                          testing::ValuesIn(kCases)),
                         caseName);

} // namespace
} // namespace celadon
