#pragma once

#include "renderer/splatting/accumulation.h"
#include "renderer/splatting/gpu_samples.h"
#include "renderer/splatting/raster_splat.h"
#include "renderer/splatting/splat_backend.h"

#include <functional>
#include <utility>

/// The paper's way, all of it on the GPU: mips, selection in the vertex shader, splats grown in the
/// geometry shader, blending.
namespace celadon {

class RasterBackend final : public SplatBackend {
public:
    RasterBackend(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                  const SplattingBuffer& view, const SplattingSettings& settings);

    void begin(const SolveInput& input) override;
    void add(const SolveInput& input, const LightViews& lightViews, int view,
             gl::StageTimer& timer) override;
    void finish(const SolveInput& input) override;
    [[nodiscard]] gl::Texture& exitance() override { return mSplat.exitance(); }
    void count(FrameStats& statistics) override { mSamples.count(statistics); }

    /// The buffers of the last light view, for tests and for views that explain.
    [[nodiscard]] const IrradianceBuffer& irradianceBuffer() const { return mSamples.buffer(); }
    [[nodiscard]] const SampleSelection& selection() const { return mSamples.selection(); }
    [[nodiscard]] const NodeProfiles* nodeProfiles() const { return mSamples.profiles(); }
    /// Called for each light view in use once its samples are selected and splatted.
    void observeLightViews(std::function<void()> observer) { mObserver = std::move(observer); }

private:
    GpuSamples mSamples;
    RasterSplat mSplat;
    Accumulation mAccumulation;
    std::function<void()> mObserver;
};

} // namespace celadon
