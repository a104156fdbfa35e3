#pragma once

#include "renderer/gl/program.h"
#include "renderer/gpu_materials.h"
#include "renderer/splatting/splatting_buffer.h"

#include <span>

/// Step 4 (Chen et al. 2012, eq. 17; DESIGN 3.4): B^k += upsampled B^(k+1), from coarse to fine, in
/// place; level 0 then holds the exitance.
namespace celadon {

class Accumulation {
public:
    Accumulation(const gl::ShaderLibrary& shaders, int materialCount, const SplattingBuffer& view);

    /// @param exitance    B of every level
    /// @param ringStartMm per level: where its ring begins, for the mean material at mean depth
    void accumulate(const gl::Texture& exitance, const SplattingBuffer& view,
                    std::span<const double> ringStartMm) const;

private:
    std::vector<gl::Texture> mFarEnergies; ///< of level 1, 2, …
    gl::Program mFarEnergy, mProgram;
};

} // namespace celadon
