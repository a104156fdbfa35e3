// The profile of a node is the flux-weighted mean of sqrt(P) over the lit texels below it, and its
// radii are those of that profile (DESIGN 3.1): the shaders against C++.
#include "renderer/splatting/splatting_solver.h"
#include "subedit/effective_radius.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"
#include "tests/support/tolerance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace celadon {
namespace {

/// Of |ln P|, per rounding: halves have 11 bits, and a driver may cut them off (llvmpipe does).
/// Once in the material's texture and once a level.
constexpr double kHalfRounding = 1.0 / 1024.0;
/// Of a knot spacing: the shader interpolates radii linearly in energy within a segment.
constexpr double kRadiusTolerance = 0.1;

TEST(NodeProfiles, AreMeansOfTheTexelsBelow) {
    const std::unique_ptr<gl::Context> context = gl::createContext(test::testContextKind());
    constexpr glm::ivec2 kPicture(16, 12);
    const MaterialPointer material = test::chessboardMaterial();
    const subedit::MaterialMap& map = *material;
    const World world = test::makeWorld("builtin:sphere", material);
    FrameSettings settings = test::smallFrame(kPicture, 64);
    settings.layers = false;
    settings.splatting.backend = SplatBackendKind::Raster;
    FrameRenderer renderer(*context, world, settings);
    const RenderedFrame frame = renderer.render(test::defaultCamera(world, kPicture),
                                                std::array{test::frontLight({1.0, 0.6, 0.3})});
    const RasterBackend& solver = *dynamic_cast<SplattingSolver&>(renderer.solver()).raster();
    ASSERT_NE(solver.nodeProfiles(), nullptr);
    const IrradianceBuffer& buffer = solver.irradianceBuffer();
    const gl::Texture& profiles = solver.nodeProfiles()->profiles();
    const int width = buffer.fluxes().size2d(0).x;
    const std::vector<float> fluxes = buffer.fluxes().readLevel(0);
    const std::vector<float> surfaces = buffer.surfaces().readLevel(0);
    const int knots = map.knots();
    ASSERT_EQ(profiles.size(0).z, knots); // one material: its own knots

    for (int level = 1; level <= 3; ++level) {
        const glm::ivec2 size = buffer.fluxes().size2d(level);
        const std::vector<float> extents = buffer.extents().readLevel(level);
        const std::vector<float> stored = profiles.readLevel(level - 1);
        const std::size_t nodes =
            static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
        double worstLog = 0.0;
        double worstRadius = 0.0;
        int compared = 0;
        for (int y = 0; y < size.y; y += 3) {
            for (int x = 0; x < size.x; x += 3) {
                std::vector<double> root(static_cast<std::size_t>(knots) * 3, 0.0);
                std::vector<float> texel(root.size());
                double total = 0.0;
                for (int j = y << level; j < (y + 1) << level; ++j) {
                    for (int i = x << level; i < (x + 1) << level; ++i) {
                        const std::size_t leaf = 4 * static_cast<std::size_t>(j * width + i);
                        const double w =
                            static_cast<double>(fluxes[leaf] + fluxes[leaf + 1] + fluxes[leaf + 2]);
                        if (w <= 0.0) {
                            continue;
                        }
                        map.sampleLogProfile({surfaces[leaf], surfaces[leaf + 1]}, texel.data());
                        for (std::size_t k = 0; k < root.size(); ++k) {
                            root[k] += w * std::exp(0.5 * static_cast<double>(texel[k]));
                        }
                        total += w;
                    }
                }
                if (total <= 0.0) {
                    continue;
                }
                const std::size_t node = static_cast<std::size_t>(y * size.x + x);
                std::vector<float> expected(root.size());
                for (std::size_t k = 0; k < root.size(); ++k) {
                    const double logP = std::max(2.0 * std::log(root[k] / total),
                                                 static_cast<double>(subedit::kLogProfileFloor));
                    expected[k] = static_cast<float>(logP);
                    const float value = stored[((k / 3) * nodes + node) * 4 + k % 3];
                    worstLog = std::max(worstLog, std::abs(static_cast<double>(value) - logP) /
                                                      std::abs(logP));
                }
                const glm::dvec3 radii = subedit::effectiveRadiusMm(
                    {expected.data(), map.segments, map.maxRadiusMm}, 0.95);
                const double radius = std::max({radii.x, radii.y, radii.z});
                const double spacing = static_cast<double>(map.maxRadiusMm) / map.segments;
                worstRadius = std::max(
                    worstRadius,
                    std::abs(static_cast<double>(extents[4 * node + 2]) - radius) / spacing);
                ++compared;
            }
        }
        ASSERT_GT(compared, 3);
        fmt::print(
            "[ measured ] level {}, {} nodes: ln P {:.5f} relative, R_P {:.4f} knot spacings\n",
            level, compared, worstLog, worstRadius);
        EXPECT_LT(worstLog, kHalfRounding * (level + 1));
        EXPECT_LT(worstRadius, kRadiusTolerance);
    }
}

} // namespace
} // namespace celadon
