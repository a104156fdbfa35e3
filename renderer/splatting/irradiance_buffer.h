#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/gpu_materials.h"
#include "renderer/gpu_world.h"
#include "renderer/surface_draw.h"

/// Step 1, light side (Chen et al. 2012, section 4; DESIGN 3.1): what one light view sees, as a
/// pyramid of patches. Level 0 has N x N texels; sizes are padded to a multiple of 2^(levels - 1),
/// so that level k has at least ceil(N / 2^k) texels and missing ones are background.
namespace celadon {

class IrradianceBuffer {
public:
    /// @param size N >= 1; @param levels >= 1
    /// @param patchVariance  as SplattingSettings
    IrradianceBuffer(const gl::ShaderLibrary& shaders, int materialCount, int size, int levels,
                     double patchVariance = 1.0);

    /// Draws level 0 from a view of this buffer's size. The frame's, the materials' and the light
    /// view's uniform blocks are bound.
    void draw(const GpuWorld& world);
    /// After profiles were edited, and nothing else changed: level 0 of kepts(), and of extents()
    /// R_P and R_cut, the rest of them being lost.
    /// @param surfaces as draw() left them
    void refreshRadii(const gl::Texture& surfaces);
    /// Levels 1 and up, and the depth ranges; reads the solve block.
    void buildMips();

    [[nodiscard]] int size() const { return mSize; }
    [[nodiscard]] int paddedSize() const { return mPaddedSize; }
    [[nodiscard]] int levels() const { return mLevels; }
    /// Contents: the outputs of irradiance_buffer.frag.
    [[nodiscard]] const gl::Texture& positions() const { return mTargets[0]; }
    [[nodiscard]] const gl::Texture& normals() const { return mTargets[1]; }
    [[nodiscard]] const gl::Texture& fluxes() const { return mTargets[2]; }
    [[nodiscard]] const gl::Texture& surfaces() const { return mTargets[3]; }
    [[nodiscard]] const gl::Texture& covariances() const { return mTargets[4]; }
    [[nodiscard]] const gl::Texture& extents() const { return mTargets[5]; }
    [[nodiscard]] const gl::Texture& kepts() const { return mTargets[6]; }
    [[nodiscard]] const gl::Texture& target(int i) const { return mTargets[i]; }
    static constexpr int kTargets = 7;
    [[nodiscard]] const gl::Texture& depthRanges() const { return mDepthRanges; }

private:
    int mSize, mLevels, mPaddedSize;
    gl::Texture mTargets[kTargets]; ///< RGBA32F, all levels
    gl::Texture mDepth;
    gl::Texture mDepthRanges; ///< RG32F, all levels: least and greatest depth in mm
    gl::Framebuffer mFramebuffer;
    SurfaceDraw mDraw;
    gl::Program mRadii, mMip, mRangeMip;
};

/// The size that halves without a rest down to the last of `levels`.
[[nodiscard]] glm::ivec2 paddedSize(glm::ivec2 size, int levels);

} // namespace celadon
