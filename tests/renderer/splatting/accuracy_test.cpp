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
