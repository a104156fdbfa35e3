#pragma once

#include "renderer/splatting/accumulation.h"
#include "renderer/splatting/gpu_samples.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/tile_gather.h"

/// All of it on the GPU, without rasterizing splats: tiles of pixels gather in compute shaders.
namespace celadon {

class TiledBackend final : public SplatBackend {
public:
    TiledBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> maps,
                 const GpuMaterials& materials, const SplattingBuffer& view,
                 const SplattingSettings& settings);

    void begin(const SolveInput& input) override;
    void add(const SolveInput& input, const LightViews& lightViews, int view,
             gl::StageTimer& timer) override;
    void finish(const SolveInput& input) override;
    [[nodiscard]] gl::Texture& exitance() override { return mGather.exitance(); }
    void count(FrameStats& statistics) override { mSamples.count(statistics); }

    [[nodiscard]] const TileGather& gather() const { return mGather; }

private:
    GpuSamples mSamples;
    TileGather mGather;
    Accumulation mAccumulation;
};

} // namespace celadon
