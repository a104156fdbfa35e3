#pragma once

#include "renderer/gl/framebuffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/splatting/gpu_samples.h"
#include "renderer/splatting/splatting_buffer.h"
#include "renderer/splatting/splatting_settings.h"

#include <optional>
#include <vector>

/// Step 3, the paper's way (Chen et al. 2012, section 4; DESIGN 3.3): the geometry shader grows
/// each selected node to a rectangle, the fragment shader evaluates each (sample, pixel) pair,
/// blending adds up B^k.
namespace celadon {

class RasterSplat {
public:
    RasterSplat(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                const SplattingBuffer& view, Scheme scheme);

    /// B of every level becomes zero.
    void clear();
    /// Adds the samples of one light view to B of one level of the splatting buffer. The frame,
    /// light, material and solve blocks are bound.
    void splat(int splattingLevel, const SplattingBuffer& view, const GpuSamples& samples,
               const GpuMaterials& materials);

    /// RGBA32F with the levels of the splatting buffer: B^k in W/m^2; alpha counts pairs.
    [[nodiscard]] gl::Texture& exitance() { return mExitance; }

private:
    gl::Texture mExitance;
    std::vector<gl::Framebuffer> mFramebuffers;
    gl::Program mLeaf;                ///< nodes of level 0
    std::optional<gl::Program> mNode; ///< nodes above; not needed where profiles are homogeneous
};

} // namespace celadon
