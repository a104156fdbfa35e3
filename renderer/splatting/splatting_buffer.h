#pragma once

#include "renderer/covered_tiles.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/gpu_blocks.h"
#include "renderer/gpu_materials.h"
#include "renderer/gpu_world.h"
#include "renderer/scene/camera.h"
#include "renderer/surface_draw.h"

#include <cstdint>
#include <optional>
#include <span>

/// Step 1, camera side (Chen et al. 2012, section 4; DESIGN 3.3): the visible surface at frame
/// resolution, with median mips. Rows run from the bottom. Sizes are padded as in IrradianceBuffer.
namespace celadon {

class SplattingBuffer {
public:
    /// @param size frame; @param levels >= 1
    SplattingBuffer(const gl::ShaderLibrary& shaders, int materialCount, glm::ivec2 size,
                    int levels);

    /// Draws level 0 with all looks and binds the frame block and the bounds.
    /// @param morePlaces @return as SurfaceDraw::draw
    const TriangleRaster* draw(const GpuWorld& world, const CameraView& view,
                               std::span<const glm::vec2> morePlaces = {});
    /// The frame block of the last draw() and the bounds, as draw() leaves them.
    void bind(const GpuWorld& world) const;
    /// After profiles were edited, and nothing else changed: R_P, in every level that was built.
    void refreshRadii();
    /// Another number after each draw().
    [[nodiscard]] std::uint64_t drawn() const { return mDrawn; }
    /// Runs a compute shader (include/covered_group.glsl), which is in use, for each pixel of a
    /// level where something is seen, and for others.
    void dispatchCovered(const gl::Program& program, int level) const;
    /// The same for a pass that writes the background too, whose `touched` is.
    void dispatchTouched(const gl::Program& program, int level, TouchedTiles& touched) const;
    /// Around all that is seen: x, y, width, height in pixels of level 0; may be more than that.
    [[nodiscard]] glm::ivec4 bounds() const { return mBounds; }
    /// These pixels; null where the driver draws.
    [[nodiscard]] const CoveredTiles* coveredTiles() const { return mTiles ? &*mTiles : nullptr; }
    /// Levels 1 and up of positions, normals and surfaces, unless they are of the last draw().
    void buildMips();
    /// Depths that count as one surface in them, in bounding sphere diameters.
    static constexpr double kClusterDepth = 0.01;
    /// For backends that draw splats, see tileRanges().
    void buildTileRanges();

    [[nodiscard]] glm::ivec2 size() const { return mSize; }
    [[nodiscard]] glm::ivec2 paddedSize() const { return mPaddedSize; }
    [[nodiscard]] int levels() const { return mLevels; }
    /// Contents: the outputs of splatting_buffer.frag. Looks have level 0 only.
    [[nodiscard]] const gl::Texture& positions() const { return mTargets[0]; }
    [[nodiscard]] const gl::Texture& normals() const { return mTargets[1]; }
    [[nodiscard]] const gl::Texture& surfaces() const { return mTargets[2]; }
    [[nodiscard]] const gl::Texture& lobes() const { return mTargets[3]; }
    [[nodiscard]] const gl::Texture& bases() const { return mTargets[4]; }
    [[nodiscard]] const gl::Texture& emissions() const { return mTargets[5]; }
    /// Reversed, 0 where nothing is seen; of the padded size.
    [[nodiscard]] const gl::Texture& depth() const { return mDepth; }
    /// RG32F: least and greatest view depth of scattering surface in tiles of 8 x 8 pixels of level
    /// 0 and, in its mips, of 2 x 2 of those; empty tiles have least > greatest.
    [[nodiscard]] const gl::Texture& tileRanges() const { return mTileRanges; }

private:
    static constexpr int kTargets = 6;
    glm::ivec2 mSize;
    int mLevels;
    glm::ivec2 mPaddedSize;
    glm::ivec4 mBounds;
    gl::Texture mTargets[kTargets];
    gl::Texture mDepth;
    gl::Texture mTileRanges;
    gl::Framebuffer mFramebuffer;
    gl::Buffer mFrameBlock;
    SurfaceDraw mDraw;
    std::optional<CoveredTiles> mTiles; ///< with Rasterizer::Processor
    std::vector<TouchedTiles> mMipTiles;
    gl::Program mRadii, mMip, mTileRange;
    std::uint64_t mDrawn = 0;
    std::uint64_t mMipsOf = 0; ///< the drawing that has them
};

/// The frame block of a view. Frame and padded size in pixels.
[[nodiscard]] blocks::FrameBlock makeFrameBlock(const CameraView& view, glm::ivec2 size,
                                                glm::ivec2 paddedSize);

} // namespace celadon
