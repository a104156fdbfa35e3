#include "renderer/splatting/raster_backend.h"

#include <string>

namespace celadon {

RasterBackend::RasterBackend(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                             const SplattingBuffer& view, const SplattingSettings& settings)
    : mSamples(shaders, materials, settings),
      mSplat(shaders, materials, view, settings.scheme),
      mAccumulation(shaders, materials.count(), settings.scheme, view) {}

void RasterBackend::begin(const SolveInput& input) {
    input.view.buildMips();
    input.view.buildTileRanges();
    mSplat.clear();
}

void RasterBackend::add(const SolveInput& input, const LightViews& lightViews, int view,
                        gl::StageTimer& timer) {
    {
        const auto scope = timer.measure("irradianceBuffer");
        mSamples.build(input.gpuWorld);
    }
    for (int k = 0; k < input.view.levels() && !input.isInterrupted(); ++k) {
        if (k == 0 || mSamples.balls() != nullptr) {
            const auto scope = timer.measure("selection");
            mSamples.select(k);
        }
        const auto scope = timer.measure("splatting " + std::to_string(k));
        mSplat.splat(k, input.view, mSamples, input.materials);
    }
    if (mObserver && lightViews.isUsed(view)) {
        mObserver();
    }
}

void RasterBackend::finish(const SolveInput& input) {
    mAccumulation.accumulate(exitance(), input.view, input.materials);
}

} // namespace celadon
