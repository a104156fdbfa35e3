// The backends of the splatting solver have one meaning: the same samples, the same flux, the same
// exitance.
#include "renderer/splatting/splatting_solver.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(60, 44); // no multiple of a tile or of a coarse pixel
constexpr int kIrradianceSize = 120;   // no power of two

struct BackendCase {
    const char* name;
    const char* model;
    const char* material;
    Scheme scheme;
    double pointLightRadii = 0.0; ///< a point light so far from the center; 0: two directional ones
    bool adaptive = true;
    bool multiresolution = true;
};

class SplatBackends : public test::GlTest, public testing::WithParamInterface<BackendCase> {
protected:
    static std::vector<Light> lightsOf(const BackendCase& given, const World& world) {
        if (given.pointLightRadii == 0.0) {
            return {test::frontLight({1.0, 0.8, 0.6}), test::backLight()};
        }
        const BoundingSphere& sphere = world.scatteringSphere;
        const glm::dvec3 side = glm::normalize(glm::dvec3(-0.4, 0.5, 0.8));
        return {test::pointLight(sphere.center + given.pointLightRadii * sphere.radius * side)};
    }

    static void expectSame(const char* what, const RenderedFrame& frame,
                           const RenderedFrame& raster) {
        SCOPED_TRACE(what);
        const ValueErrors errors = test::compareExitance(frame.image, raster.image);
        fmt::print("[ measured ] {} {}: relative RMSE {:.2g}, pairs {} and {}\n", GetParam().name,
                   what, errors.relativeRmse, frame.stats.samples.pairs,
                   raster.stats.samples.pairs);
        EXPECT_LT(errors.relativeRmse, test::kBackends);
        EXPECT_NEAR(errors.meanRatio, 1.0, 0.3 * test::kBackends);
        for (std::size_t c = 0; c < 3; ++c) {
            const double lit = raster.stats.flux.lit[c];
            EXPECT_NEAR(frame.stats.flux.lit[c], lit, 1e-6 * lit);
            EXPECT_NEAR(frame.stats.flux.selected[c], lit, 1e-4 * lit);
        }
        // A node at a threshold may fall on either side of it.
        ASSERT_EQ(frame.stats.samples.selected.size(), raster.stats.samples.selected.size());
        for (std::size_t k = 0; k < frame.stats.samples.selected.size(); ++k) {
            const auto expected = static_cast<double>(raster.stats.samples.selected[k]);
            EXPECT_NEAR(static_cast<double>(frame.stats.samples.selected[k]), expected,
                        2.0 + 0.002 * expected)
                << "level " << k;
        }
        EXPECT_NEAR(static_cast<double>(frame.stats.samples.pairs),
                    static_cast<double>(raster.stats.samples.pairs),
                    1e-3 * static_cast<double>(raster.stats.samples.pairs));
    }
};

class AutoBackend : public test::GlTest {};
class ManySamples : public test::GlTest {};
class EnergyOfHierarchicalScheme : public test::GlTest {};

TEST_P(SplatBackends, CpuAndTiledAreRaster) {
    const BackendCase& given = GetParam();
    const World world = test::makeWorld(given.model, test::materialNamed(given.material));
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::vector<Light> lights = lightsOf(given, world);
    FrameSettings settings = test::smallFrame(kPicture, kIrradianceSize, given.scheme);
    settings.splatting.adaptive = given.adaptive;
    settings.splatting.multiresolution = given.multiresolution;
    settings.statistics = true;
    const auto render = [&](SplatBackendKind backend) {
        settings.splatting.backend = backend;
        return test::renderFrame(context(), world, settings, camera, lights);
    };
    const RenderedFrame raster = render(SplatBackendKind::Raster);
    EXPECT_GT(raster.stats.samples.pairs, 0u);
    expectSame("cpu", render(SplatBackendKind::Cpu), raster);
    expectSame("tiled", render(SplatBackendKind::Tiled), raster);
}

constexpr BackendCase kCases[] = {
    {"HierarchicalShort", "builtin:vase", "short", Scheme::Hierarchical},
    {"HierarchicalMedium", "builtin:vase", "medium", Scheme::Hierarchical},
    {"HierarchicalChessboard", "builtin:vase", "chessboard", Scheme::Hierarchical},
    {"HierarchicalPointLight", "builtin:sphere", "chessboard", Scheme::Hierarchical, 3.0},
    {"HierarchicalCubeFaces", "builtin:sphere", "medium", Scheme::Hierarchical, 1.1},
    {"PaperLong", "builtin:vase", "long", Scheme::Paper},
    {"PaperChessboard", "builtin:vase", "chessboard", Scheme::Paper},
    {"PaperPointLight", "builtin:sphere", "chessboard", Scheme::Paper, 3.0},
    {"PaperNeither", "builtin:vase", "medium", Scheme::Paper, 0.0, false, false},
};

INSTANTIATE_TEST_SUITE_P(Cases, SplatBackends, testing::ValuesIn(kCases),
                         [](const auto& instance) { return instance.param.name; });

// A tile that a hundred thousand samples reach, each a small disc beside its distance: no driver's
// limit on loops leaves any out, and the discs are blurred alike.
TEST_F(ManySamples, OfATileCountAll) {
    constexpr glm::ivec2 kTiles(16, 8);
    const World world = test::makeWorld("builtin:sphere", test::materialNamed("long"));
    const Camera camera = test::defaultCamera(world, kTiles);
    const std::array lights{test::frontLight()};
    FrameSettings settings = test::smallFrame(kTiles, 384, Scheme::Paper);
    settings.splatting.adaptive = settings.splatting.multiresolution = false;
    settings.statistics = true;
    const auto render = [&](SplatBackendKind backend) {
        settings.splatting.backend = backend;
        return test::renderFrame(context(), world, settings, camera, lights);
    };
    const RenderedFrame cpu = render(SplatBackendKind::Cpu);
    const RenderedFrame tiled = render(SplatBackendKind::Tiled);
    const ValueErrors errors = test::compareExitance(tiled.image, cpu.image);
    fmt::print("[ measured ] relative RMSE {:.2g}, mean ratio - 1 {:.2g}, pairs {} and {}\n",
               errors.relativeRmse, errors.meanRatio - 1.0, tiled.stats.samples.pairs,
               cpu.stats.samples.pairs);
    EXPECT_GT(cpu.stats.samples.selected[0], 100'000u);
    EXPECT_LT(errors.relativeRmse, test::kBackends);
    EXPECT_NEAR(static_cast<double>(tiled.stats.samples.pairs),
                static_cast<double>(cpu.stats.samples.pairs),
                1e-3 * static_cast<double>(cpu.stats.samples.pairs));
}

// What a GPU does in its first frame: measures, stays with the faster, and means the same.
TEST_F(AutoBackend, StaysWithWhatItMeasured) {
    const World world = test::makeWorld("builtin:sphere", test::materialNamed("medium"));
    constexpr glm::ivec2 kSmall(40, 30);
    const FrameSettings settings = test::smallFrame(kSmall, 32, Scheme::Hierarchical);
    const GpuScene scene(world, settings);
    scene.materials.bind();
    SplattingBuffer view(scene.shaders, scene.materials.count(), kSmall,
                         SplattingSolver::viewLevels(settings.splatting));
    const CameraView camera =
        makeCameraView(test::defaultCamera(world, kSmall), kSmall.x, kSmall.y);
    view.draw(scene.gpuWorld, camera);
    const std::array lights{test::frontLight()};
    const SolveInput input{world, scene.gpuWorld, scene.materials, view, camera, lights};
    gl::StageTimer timer(context());
    const auto solve = [&](SplattingSolver& solver) {
        return solver.solve(input, timer).readLevel(0);
    };
    const auto make = [&](SplatBackendKind backend) {
        SplattingSettings splatting = settings.splatting;
        splatting.backend = backend;
        return SplattingSolver(scene.shaders, world.materials, scene.materials, view, splatting);
    };
    SplattingSolver raster = make(SplatBackendKind::Raster);
    SplattingSolver measured = make(SplatBackendKind::Auto);
    const std::vector<float> expected = solve(raster);
    const std::size_t stages = timer.take().size();
    const std::vector<float> exitance = solve(measured);
    EXPECT_LE(timer.take().size(), stages) << "the measurement is no part of the frame";
    EXPECT_TRUE(measured.backend() == SplatBackendKind::Raster ||
                measured.backend() == SplatBackendKind::Tiled);
    const float largest = std::ranges::max(expected);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(exitance[i], expected[i], test::kBackends * largest) << i;
    }
    SplattingSolver next = make(SplatBackendKind::Auto);
    static_cast<void>(solve(next));
    EXPECT_EQ(next.backend(), measured.backend());
}

// The hierarchical scheme cuts nothing, so it must not give anything back either.
TEST_F(EnergyOfHierarchicalScheme, IsAll) {
    const World world = test::makeWorld("builtin:sphere", test::materialNamed("chessboard"));
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::array lights{test::frontLight()};
    FrameSettings settings = test::smallFrame(kPicture, 64, Scheme::Hierarchical);
    for (const SplatBackendKind backend : {SplatBackendKind::Cpu, SplatBackendKind::Tiled}) {
        settings.splatting.backend = backend;
        settings.splatting.energy = 1.0;
        const FloatImage all = test::renderFrame(context(), world, settings, camera, lights).image;
        settings.splatting.energy = 0.8;
        const FloatImage cut = test::renderFrame(context(), world, settings, camera, lights).image;
        EXPECT_LT(test::compareExitance(cut, all).relativeRmse, 1e-6);
    }
}

} // namespace
} // namespace celadon
