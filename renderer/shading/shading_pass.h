#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/splatting/splatting_buffer.h"

/// Outgoing radiance at pixel centers (Chen et al. 2012, eq. 7): exitance through the surface, plus
/// direct light, plus emission.
namespace celadon {

class ShadingPass {
public:
    /// @param leastCosine as FrameSettings
    ShadingPass(const gl::ShaderLibrary& shaders, int materialCount, const SplattingBuffer& view,
                double leastCosine);

    /// The frame and material blocks are bound.
    void shade(const SplattingBuffer& view, const gl::Texture& exitance, const gl::Texture& direct);

    /// RGBA32F, frame size: W/m^2/sr; alpha 1 where a surface is seen at the pixel's center.
    [[nodiscard]] const gl::Texture& radiance() const { return mRadiance; }

private:
    gl::Texture mRadiance;
    gl::Program mProgram;
    TouchedTiles mTiles;
};

} // namespace celadon
