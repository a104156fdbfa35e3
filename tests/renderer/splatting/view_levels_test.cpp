// The splatting buffer's coarser levels are the same made by the shader and by the processor, which
// may know a part of the picture only.
#include "renderer/frame_renderer.h"
#include "renderer/gather/view_level.h"
#include "renderer/splatting/splatting_buffer.h"
#include "tests/support/frames.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/materials.h"

#include <gtest/gtest.h>

#include <vector>

namespace celadon {
namespace {

constexpr glm::ivec2 kPicture(90, 70);
constexpr int kLevels = 4;

class ViewLevels : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        mView.draw(mScene.gpuWorld,
                   makeCameraView(test::defaultCamera(mWorld, kPicture), kPicture.x, kPicture.y));
    }

    /// @param corner, end of level 0, multiples of the coarsest pixel
    [[nodiscard]] std::vector<ViewLevel> levelsOf(glm::ivec2 corner, glm::ivec2 end) const {
        std::vector<ViewLevel> levels(kLevels);
        for (int k = 0; k < kLevels; ++k) {
            levels[static_cast<std::size_t>(k)].part =
                glm::ivec4(corner >> k, (end >> k) - (corner >> k));
        }
        const glm::ivec3 offset(corner, 0);
        const glm::ivec3 extent(end - corner, 1);
        levels[0].positions = mView.positions().readRegion(0, offset, extent);
        levels[0].normals = mView.normals().readRegion(0, offset, extent);
        levels[0].surfaces = mView.surfaces().readRegion(0, offset, extent);
        makeCoarserLevels(levels, static_cast<float>(SplattingBuffer::kClusterDepth) * 2.0f *
                                      mScene.gpuWorld.readBounds().scattering.w);
        return levels;
    }

    World mWorld = test::makeWorld("builtin:vase", test::materialNamed("chessboard"));
    FrameSettings mSettings = test::smallFrame(kPicture, 32);
    GpuScene mScene{mWorld, mSettings};
    SplattingBuffer mView{mScene.shaders, mScene.materials.count(), kPicture, kLevels};
};

TEST_F(ViewLevels, AreThoseOfTheShader) {
    const std::vector<ViewLevel> levels = levelsOf({0, 0}, mView.paddedSize());
    mView.buildMips();
    for (int k = 1; k < kLevels; ++k) {
        const ViewLevel& level = levels[static_cast<std::size_t>(k)];
        const std::vector<float> positions = mView.positions().readLevel(k);
        const std::vector<float> normals = mView.normals().readLevel(k);
        const std::vector<float> surfaces = mView.surfaces().readLevel(k);
        ASSERT_EQ(level.positions.size(), positions.size());
        int covered = 0;
        for (std::size_t i = 0; i < positions.size() / 4; ++i) {
            ASSERT_EQ(level.scatters(i), positions[4 * i + 3] > 0.0f) << "level " << k;
            if (!level.scatters(i)) {
                continue;
            }
            ++covered;
            for (std::size_t c = 0; c < 4; ++c) {
                ASSERT_NEAR(level.positions[4 * i + c], positions[4 * i + c], 1e-4f);
                ASSERT_EQ(level.surfaces[4 * i + c], surfaces[4 * i + c]);
                if (c < 3) {
                    ASSERT_NEAR(level.normals[4 * i + c], normals[4 * i + c], 1e-5f);
                }
            }
        }
        EXPECT_GT(covered, 10) << "level " << k;
    }
}

TEST_F(ViewLevels, OfAPartAreThoseOfTheWhole) {
    const std::vector<ViewLevel> whole = levelsOf({0, 0}, mView.paddedSize());
    const std::vector<ViewLevel> part = levelsOf({32, 16}, {64, 56});
    for (std::size_t k = 0; k < kLevels; ++k) {
        const glm::ivec4& in = part[k].part;
        int covered = 0;
        for (int y = in.y; y < in.y + in.w; ++y) {
            for (int x = in.x; x < in.x + in.z; ++x) {
                const std::size_t there = part[k].indexOf({x, y});
                const std::size_t here = whole[k].indexOf({x, y});
                for (std::size_t c = 0; c < 4; ++c) {
                    ASSERT_EQ(part[k].positions[4 * there + c], whole[k].positions[4 * here + c]);
                    ASSERT_EQ(part[k].surfaces[4 * there + c], whole[k].surfaces[4 * here + c]);
                }
                covered += part[k].scatters(there) ? 1 : 0;
            }
        }
        EXPECT_GT(covered, 4) << "level " << k;
        EXPECT_EQ(part[k].indexOf(glm::ivec2(in) - 1), ViewLevel::kNowhere);
        EXPECT_EQ(part[k].indexOf(glm::ivec2(in) + glm::ivec2(in.z, 0)), ViewLevel::kNowhere);
    }
}

TEST_F(ViewLevels, TakeNewRadiiFromTheFinest) {
    std::vector<ViewLevel> levels = levelsOf({0, 0}, mView.paddedSize());
    for (std::size_t i = 0; i < levels[0].surfaces.size() / 4; ++i) {
        levels[0].surfaces[4 * i + 3] = static_cast<float>(i); // none like another
    }
    copyRadiiUp(levels);
    for (std::size_t k = 1; k < kLevels; ++k) {
        for (std::size_t i = 0; i < levels[k].seenAs.size(); ++i) {
            if (!levels[k].scatters(i)) {
                continue;
            }
            const auto seen = static_cast<std::size_t>(levels[k].surfaces[4 * i + 3]);
            ASSERT_EQ(levels[k].surfaces[4 * i], levels[0].surfaces[4 * seen]);
            ASSERT_EQ(levels[k].surfaces[4 * i + 1], levels[0].surfaces[4 * seen + 1]);
        }
    }
}

} // namespace
} // namespace celadon
