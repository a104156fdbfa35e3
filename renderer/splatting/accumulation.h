#pragma once

#include "renderer/gl/program.h"
#include "renderer/gpu_materials.h"
#include "renderer/splatting/splatting_buffer.h"

/// Step 4 (Chen et al. 2012, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1), from coarse to fine, in
/// place; level 0 then holds the exitance.
namespace celadon {

class Accumulation {
public:
    Accumulation(const gl::ShaderLibrary& shaders, int materialCount);

    /// @param exitance     B of every level
    /// @param meanDepthMm  of the object, where the rings of the mean material are taken
    void accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                    const GpuMaterials& materials, const PixelWidth& pixelWidth,
                    double meanDepthMm) const;

private:
    gl::Program mProgram;
};

} // namespace celadon
