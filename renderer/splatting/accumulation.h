#pragma once

#include "renderer/gl/program.h"
#include "renderer/gpu_materials.h"
#include "renderer/listed_pixels.h"
#include "renderer/splatting/splatting_buffer.h"
#include "renderer/splatting/splatting_settings.h"

#include <vector>

/// Step 4 (Chen et al. 2012, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1), from coarse to fine, in
/// place; level 0 then holds the exitance.
namespace celadon {

class Accumulation {
public:
    Accumulation(const gl::ShaderLibrary& shaders, int materialCount, Scheme scheme,
                 const SplattingBuffer& view);

    /// The frame, bounds, material and solve blocks are bound.
    /// @param exitance B of every level
    void accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                    const GpuMaterials& materials);

private:
    /// Of a level, for the next finer one. The paper's scheme sharpens nothing.
    struct Light {
        gl::Texture asGathered, sharpened;
    };
    const gl::Texture& findLight(const gl::Texture& exitance, const SplattingBuffer& view,
                                 int level) const;

    std::vector<Light> mLights; ///< of level 1, 2, …
    ListedPixels mRoughPixels;  ///< of one level
    gl::Program mFarLight, mSharpening, mSmooth, mRough;
};

} // namespace celadon
