// The backends of the splatting solver have one meaning: the same samples, the same flux, the same
// exitance.
#include "renderer/splatting/splatting_solver.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(100, 76); // no multiple of a tile or of a coarse pixel
constexpr int kIrradianceSize = 120;    // no power of two

struct BackendCase {
    const char* name;
    const char* material;
    Scheme scheme;
    bool adaptive = true;
    bool multiresolution = true;
};

class SplatBackends : public test::GlTest, public testing::WithParamInterface<BackendCase> {};

TEST_P(SplatBackends, CpuIsRaster) {
    const BackendCase& given = GetParam();
    const World world = test::makeWorld("builtin:vase", test::materialNamed(given.material));
    const Camera camera = test::defaultCamera(world, kPicture);
    const std::array lights{test::frontLight({1.0, 0.8, 0.6}), test::backLight()};
    FrameSettings settings = test::smallFrame(kPicture, kIrradianceSize, given.scheme);
    settings.splatting.adaptive = given.adaptive;
    settings.splatting.multiresolution = given.multiresolution;
    settings.statistics = true;
    settings.splatting.backend = SplatBackendKind::Raster;
    const RenderedFrame raster = test::renderFrame(context(), world, settings, camera, lights);
    settings.splatting.backend = SplatBackendKind::Cpu;
    const RenderedFrame cpu = test::renderFrame(context(), world, settings, camera, lights);

    const ValueErrors errors = test::compareExitance(cpu.image, raster.image);
    fmt::print("[ measured ] {}: relative RMSE {:.2g}, pairs {} and {}\n", given.name,
               errors.relativeRmse, cpu.stats.samples.pairs, raster.stats.samples.pairs);
    EXPECT_LT(errors.relativeRmse, test::kBackends);
    EXPECT_NEAR(errors.meanRatio, 1.0, 0.3 * test::kBackends);
    for (std::size_t c = 0; c < 3; ++c) {
        const double lit = raster.stats.flux.lit[c];
        EXPECT_NEAR(cpu.stats.flux.lit[c], lit, 1e-6 * lit);
        EXPECT_NEAR(cpu.stats.flux.selected[c], lit, 1e-4 * lit);
    }
    // A node at a threshold may fall on either side of it.
    ASSERT_EQ(cpu.stats.samples.selected.size(), raster.stats.samples.selected.size());
    for (std::size_t k = 0; k < cpu.stats.samples.selected.size(); ++k) {
        const auto expected = static_cast<double>(raster.stats.samples.selected[k]);
        EXPECT_NEAR(static_cast<double>(cpu.stats.samples.selected[k]), expected,
                    2.0 + 0.002 * expected)
            << "level " << k;
    }
    EXPECT_NEAR(static_cast<double>(cpu.stats.samples.pairs),
                static_cast<double>(raster.stats.samples.pairs),
                1e-3 * static_cast<double>(raster.stats.samples.pairs));
}

constexpr BackendCase kCases[] = {
    {"HierarchicalShort", "short", Scheme::Hierarchical},
    {"HierarchicalMedium", "medium", Scheme::Hierarchical},
    {"HierarchicalChessboard", "chessboard", Scheme::Hierarchical},
    {"PaperLong", "long", Scheme::Paper},
    {"PaperChessboard", "chessboard", Scheme::Paper},
    {"PaperNeither", "medium", Scheme::Paper, false, false},
};

INSTANTIATE_TEST_SUITE_P(Cases, SplatBackends, testing::ValuesIn(kCases),
                         [](const auto& instance) { return instance.param.name; });

} // namespace
} // namespace celadon
