// The invariant of adaptive selection (DESIGN 3.2): every lit texel of level 0 is covered by
// exactly one selected sample, and the selected flux is the lit flux. Checked by painting: each
// selected node marks the level-0 texels below it.
#include "renderer/splatting/splatting_solver.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <vector>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(16, 12); // splats are not looked at here
constexpr int kIrradianceSize = 128;
constexpr double kAlpha = 3.0; ///< so that all levels take part at this small size

/// What painting the selection of one light view found.
struct PaintedView {
    std::size_t lit = 0;        ///< lit texels of level 0
    std::size_t uncovered = 0;  ///< of those, under no selected node
    std::size_t covered2 = 0;   ///< of those, under several
    std::size_t unlitNodes = 0; ///< selected nodes without flux
    std::size_t repeated = 0;   ///< nodes that are in a list twice
    std::vector<std::size_t> selected;
    std::array<double, 3> litFlux{};
    std::array<double, 3> selectedFlux{};
};

bool isLit(const std::vector<float>& fluxes, std::size_t node) {
    return fluxes[4 * node] + fluxes[4 * node + 1] + fluxes[4 * node + 2] > 0.0f;
}

void addFlux(std::array<double, 3>& sum, const std::vector<float>& fluxes, std::size_t node) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += static_cast<double>(fluxes[4 * node + c]);
    }
}

PaintedView paint(const RasterBackend& solver) {
    const gl::Texture& fluxes = solver.irradianceBuffer().fluxes();
    const glm::ivec2 size = fluxes.size2d(0);
    const std::vector<float> leaves = fluxes.readLevel(0);
    std::vector<int> coverage(leaves.size() / 4, 0);
    PaintedView view;
    for (int level = 0; level < solver.irradianceBuffer().levels(); ++level) {
        const std::vector<float> nodes = fluxes.readLevel(level);
        std::vector<std::int32_t> indices = solver.selection().readIndices(level);
        view.selected.push_back(indices.size());
        std::sort(indices.begin(), indices.end());
        view.repeated +=
            static_cast<std::size_t>(indices.end() - std::unique(indices.begin(), indices.end()));
        const int width = fluxes.size2d(level).x;
        for (const std::int32_t index : indices) {
            view.unlitNodes += isLit(nodes, static_cast<std::size_t>(index)) ? 0 : 1;
            addFlux(view.selectedFlux, nodes, static_cast<std::size_t>(index));
            const glm::ivec2 low = glm::ivec2(index % width, index / width) << level;
            const glm::ivec2 high = glm::min(low + (1 << level), size);
            for (int y = low.y; y < high.y; ++y) {
                for (int x = low.x; x < high.x; ++x) {
                    ++coverage[static_cast<std::size_t>(y * size.x + x)];
                }
            }
        }
    }
    for (std::size_t texel = 0; texel < coverage.size(); ++texel) {
        if (isLit(leaves, texel)) {
            ++view.lit;
            addFlux(view.litFlux, leaves, texel);
            view.uncovered += coverage[texel] == 0 ? 1 : 0;
            view.covered2 += coverage[texel] > 1 ? 1 : 0;
        }
    }
    return view;
}

void expectPartition(const PaintedView& view) {
    EXPECT_EQ(view.uncovered, 0u);
    EXPECT_EQ(view.covered2, 0u);
    EXPECT_EQ(view.unlitNodes, 0u);
    EXPECT_EQ(view.repeated, 0u);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(view.selectedFlux[c], view.litFlux[c], test::kFluxSum * view.litFlux[c]);
    }
}

std::size_t total(const std::vector<std::size_t>& counts) {
    std::size_t sum = 0;
    for (const std::size_t count : counts) {
        sum += count;
    }
    return sum;
}

class SampleSelectionTest : public test::GlTest {
protected:
    /// One entry a light view.
    std::vector<PaintedView> select(const World& world, const Light& light, int levels,
                                    bool adaptive = true, int irradianceSize = kIrradianceSize) {
        FrameSettings settings = test::smallFrame(kPicture, irradianceSize);
        settings.splatting.irradianceLevels = levels;
        settings.splatting.splattingLevels = 1;
        settings.splatting.alpha = kAlpha;
        settings.splatting.adaptive = adaptive;
        settings.layers = false;
        settings.splatting.backend = SplatBackendKind::Raster;
        FrameRenderer renderer(context(), world, settings);
        RasterBackend& solver = *dynamic_cast<SplattingSolver&>(renderer.solver()).raster();
        std::vector<PaintedView> views;
        solver.observeLightViews([&] { views.push_back(paint(solver)); });
        const RenderedFrame frame =
            renderer.render(test::defaultCamera(world, kPicture), std::array{light});
        return views;
    }
};

struct SelectionCase {
    const char* name;
    const char* model;
    const char* material;
};

class SelectionOf : public SampleSelectionTest,
                    public testing::WithParamInterface<SelectionCase> {};

TEST_P(SelectionOf, CoversEachLitTexelOnce) {
    if (!test::isAvailable(GetParam().model)) {
        GTEST_SKIP() << "CELADON_MODELS is not set";
    }
    const World world = test::makeWorld(GetParam().model, test::materialNamed(GetParam().material));
    const glm::dvec3 center = world.scatteringSphere.center;
    const double radius = world.scatteringSphere.radius;
    const glm::dvec3 side = glm::normalize(glm::dvec3(0.5, 0.6, 0.7));
    struct {
        const char* name;
        Light light;
        std::size_t views;
    } const lights[] = {{"directional", test::frontLight(), 1},
                        {"point outside", test::pointLight(center + 3.0 * radius * side), 1},
                        {"point near", test::pointLight(center + 1.1 * radius * side), 6}};
    for (const auto& [name, light, viewCount] : lights) {
        SCOPED_TRACE(name);
        const std::vector<PaintedView> views = select(world, light, 6);
        EXPECT_EQ(views.size(), viewCount);
        std::size_t lit = 0;
        std::size_t selected = 0;
        for (const PaintedView& view : views) {
            expectPartition(view);
            lit += view.lit;
            selected += total(view.selected);
        }
        EXPECT_GT(lit, 1000u);
        fmt::print("[ measured ] {} {}: {} of {} lit texels are samples\n", GetParam().name, name,
                   selected, lit);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Models, SelectionOf,
    testing::Values(SelectionCase{"SphereMedium", "builtin:sphere", "medium"},
                    SelectionCase{"SphereLong", "builtin:sphere", "long"},
                    SelectionCase{"VaseLong", "builtin:vase", "long"},
                    SelectionCase{"VaseChessboard", "builtin:vase", "chessboard"},
                    SelectionCase{"BunnyLong", "mesh/bunny_watertight_60k.obj", "long"},
                    SelectionCase{"BunnyChessboard", "mesh/bunny_watertight_60k.obj", "chessboard"},
                    SelectionCase{"BuddhaLong", "mesh/happy_buddha_100k.obj", "long"}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_F(SampleSelectionTest, HoldsForEveryNumberOfLevels) {
    const World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    std::size_t last = 0;
    for (int levels = 1; levels <= 6; ++levels) {
        SCOPED_TRACE(levels);
        const std::vector<PaintedView> views = select(world, test::frontLight(), levels);
        ASSERT_EQ(views.size(), 1u);
        expectPartition(views[0]);
        ASSERT_EQ(views[0].selected.size(), static_cast<std::size_t>(levels));
        if (levels == 1) {
            EXPECT_EQ(total(views[0].selected), views[0].lit);
        } else {
            EXPECT_LE(total(views[0].selected), last); // another level never needs more samples
        }
        last = total(views[0].selected);
    }
    EXPECT_LT(last, select(world, test::frontLight(), 1)[0].lit / 2); // and they are worth having
}

TEST_F(SampleSelectionTest, SizesThatAreNoPowerOfTwoArePadded) {
    const World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    for (const int size : {97, 100, 1}) {
        SCOPED_TRACE(size);
        const std::vector<PaintedView> views = select(world, test::frontLight(), 6, true, size);
        ASSERT_EQ(views.size(), 1u);
        expectPartition(views[0]);
        EXPECT_GT(views[0].lit, 0u);
    }
}

TEST_F(SampleSelectionTest, WithoutAdaptationEachLitTexelIsASample) {
    const World world = test::makeWorld("builtin:vase", test::longRangeMaterial());
    const std::vector<PaintedView> views = select(world, test::frontLight(), 6, false);
    ASSERT_EQ(views.size(), 1u);
    expectPartition(views[0]);
    ASSERT_EQ(views[0].selected.size(), 1u);
    EXPECT_EQ(views[0].selected[0], views[0].lit);
}

TEST_F(SampleSelectionTest, ALightInsideSeesAllSixFaces) {
    // Double sided, so that the sphere's inside is lit.
    World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    world.looks[0].doubleSided = true;
    const glm::dvec3 inside = world.scatteringSphere.center + glm::dvec3(9.0, -5.0, 3.0);
    const std::vector<PaintedView> views = select(world, test::pointLight(inside), 6);
    ASSERT_EQ(views.size(), 6u);
    for (const PaintedView& view : views) {
        expectPartition(view);
        EXPECT_EQ(view.lit, static_cast<std::size_t>(kIrradianceSize * kIrradianceSize));
    }
}

TEST_F(SampleSelectionTest, ADarkViewSelectsNothing) {
    const World world = test::makeWorld("builtin:sphere", test::longRangeMaterial());
    const std::vector<PaintedView> views =
        select(world, test::directionalLight({0.0, 0.0, -1.0}, glm::dvec3(0.0)), 6);
    ASSERT_EQ(views.size(), 1u);
    EXPECT_EQ(views[0].lit, 0u);
    EXPECT_EQ(total(views[0].selected), 0u);
}

} // namespace
} // namespace celadon
