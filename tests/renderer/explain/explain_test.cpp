#include "renderer/explain/explain_pictures.h"
#include "renderer/explain/frame_difference.h"
#include "renderer/frame_quality.h"
#include "renderer/scene/surface_atlas_of_world.h"
#include "renderer/splatting/splatting_solver.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/worlds.h"

#include <gtest/gtest.h>

#include <numeric>

namespace celadon {
namespace {

class ExplainTest : public test::GlTest {
protected:
    ExplainTest() : world(test::makeWorld("builtin:shell", test::chessboardMaterial())) {
        settings = frameSettings(Quality::Draft);
        settings.size = {64, 48};
        settings.coverageSamples = 1;
        settings.splatting.backend = SplatBackendKind::Cpu;
        scene = std::make_shared<const GpuScene>(world, settings);
        camera = chooseCamera(world, {}, 64.0 / 48.0);
        light.direction = glm::normalize(glm::dvec3(0.3, -0.5, -0.8));
    }

    World world;
    FrameSettings settings;
    std::shared_ptr<const GpuScene> scene;
    Camera camera;
    Light light;
};

TEST_F(ExplainTest, SamplesHoldTheLitFluxAtEveryDistance) {
    FrameRenderer renderer(context(), scene, settings);
    ASSERT_NE(renderer.draw(camera, {&light, 1}, nullptr), nullptr);
    const auto* const splatting = dynamic_cast<SplattingSolver*>(&renderer.solver());
    ASSERT_NE(splatting, nullptr);
    const SampleTree& tree = splatting->cpu()->tree();
    const std::array<double, 3> lit = tree.count().litFlux;
    ASSERT_GT(lit[0], 0.0);
    std::size_t before = tree.levels().front().nodes.size() + 1;
    for (const float distanceMm : {0.0f, 2.0f, 10.0f, 50.0f}) {
        const std::vector<ShownSample> samples = samplesAtDistance(tree, true, distanceMm);
        glm::dvec3 flux(0.0);
        for (const ShownSample& sample : samples) {
            flux += glm::dvec3(sample.flux);
        }
        for (int c = 0; c < 3; ++c) { // float sums over some 10^4 texels
            EXPECT_NEAR(flux[c] / lit[static_cast<std::size_t>(c)], 1.0, 1e-4) << distanceMm;
        }
        EXPECT_LE(samples.size(), before) << "farther away, coarser";
        before = samples.size();
        const std::vector<std::size_t> counts = countPerLevel(samples);
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), samples.size());
    }
    EXPECT_LT(before, tree.levels().front().nodes.size() / 4);
}

TEST_F(ExplainTest, IrradiancePictureShowsWhatIsLit) {
    FrameRenderer renderer(context(), scene, settings);
    ASSERT_NE(renderer.draw(camera, {&light, 1}, nullptr), nullptr);
    const auto* const splatting = dynamic_cast<SplattingSolver*>(&renderer.solver());
    const LightTexels texels = splatting->cpu()->lightTexels();
    for (const int level : {0, 3, 99}) {
        const DisplayPixels picture = irradiancePicture(texels, level, {80, 60});
        ASSERT_EQ(picture.rgba.size(), 80u * 60u * 4u);
        int brightest = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
            brightest = i % 4 == 3 ? brightest : std::max(brightest, int(picture.rgba[i]));
        }
        EXPECT_GT(brightest, 100) << level;
    }
}

TEST_F(ExplainTest, DifferenceToTruthIsThatOfTheAccuracyTests) {
    std::atomic<bool> cancelled = false;
    const auto found =
        compareWithTruth(context(), scene, settings, camera, {&light, 1}, {}, cancelled);
    ASSERT_TRUE(found);
    EXPECT_GT(found->relativeRmse, 1e-5); // draft is no truth
    EXPECT_LT(found->relativeRmse, 0.06);
    EXPECT_NEAR(found->meanRatio, 1.0, 0.03);
    EXPECT_EQ(found->heatMap.rgba.size(), 64u * 48u * 4u);
    cancelled = true;
    EXPECT_FALSE(compareWithTruth(context(), scene, settings, camera, {&light, 1}, {}, cancelled));
}

TEST(AtlasPicture, ShowsChartsOnADarkGround) {
    subedit::MaterialMap map = *test::homogeneousMaterial(2.0);
    const World world = test::makeWorld("builtin:shell", test::homogeneousMaterial(2.0));
    const subedit::Surface surface(makeSurfaceAtlas(world, 0, 64, 64));
    subedit::MaterialMap large = map;
    large.width = large.height = 64;
    large.logProfile.clear();
    for (int i = 0; i < 64 * 64; ++i) {
        large.logProfile.insert(large.logProfile.end(), map.logProfile.begin(),
                                map.logProfile.begin() + map.knots() * 3);
    }
    const DisplayPixels picture = atlasPicture(large, surface, {128, 96});
    ASSERT_EQ(picture.rgba.size(), 128u * 96u * 4u);
    const auto green = [&](int x, int y) { return int(picture.rgba[(y * 128 + x) * 4 + 1]); };
    EXPECT_LT(green(1, 1), 40); // beside the square
    int covered = 0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 128; ++x) {
            covered += green(x, y) > 60 ? 1 : 0;
        }
    }
    EXPECT_GT(covered, 1500);
}

} // namespace
} // namespace celadon
