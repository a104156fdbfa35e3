#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/scene/world.h"
#include "renderer/splatting/gpu_samples.h"
#include "renderer/splatting/splatting_buffer.h"
#include "renderer/splatting/splatting_settings.h"

#include <span>

/// Step 3 turned around: tiles of pixels walk the tree of samples and gather, in compute shaders
/// (tile_tree.comp, tile_gather.comp). Same samples, rings and kernel as RasterSplat.
namespace celadon {

class TileGather {
public:
    TileGather(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> maps,
               const GpuMaterials& materials, const SplattingBuffer& view,
               const SplattingSettings& settings);

    /// B of every level becomes zero.
    void clear();
    /// Bounds of what lies below each node. Once a light view, after GpuSamples::build.
    void buildTree(const GpuSamples& samples);
    /// Adds a light view to B of one level of the splatting buffer. The frame, light, material and
    /// solve blocks are bound.
    void gather(int splattingLevel, const SplattingBuffer& view, const GpuSamples& samples,
                const GpuMaterials& materials);

    /// RGBA32F with the levels of the splatting buffer: B^k in W/m^2; alpha counts pairs.
    [[nodiscard]] gl::Texture& exitance() { return mExitance; }
    /// Whether profiles are kept in shared memory; else each pair reads the maps.
    [[nodiscard]] bool keepsProfiles() const { return mKeepsProfiles; }

private:
    gl::Texture mExitance;
    gl::Texture mTree; ///< RGBA32F: center, radius of what is lit below, -1: nothing
    gl::Texture mFits; ///< R32F, paper: 1 where a node is fit
    gl::Program mBuild, mGather;
    bool mKeepsProfiles = true;
    bool mInParts = false; ///< each dispatch has a part of the tree
};

} // namespace celadon
