#include "renderer/splatting/tiled_backend.h"

#include <string>

namespace celadon {

TiledBackend::TiledBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> maps,
                           const GpuMaterials& materials, const SplattingBuffer& view,
                           const SplattingSettings& settings)
    : mSamples(shaders, materials, settings),
      mGather(shaders, maps, materials, view, settings),
      mAccumulation(shaders, materials.count(), settings.scheme, view) {}

void TiledBackend::begin(const SolveInput& input) {
    input.view.buildMips();
    mGather.clear();
}

void TiledBackend::add(const SolveInput& input, const LightViews&, int, gl::StageTimer& timer) {
    {
        const auto scope = timer.measure("irradianceBuffer");
        mSamples.build(input.gpuWorld);
    }
    {
        const auto scope = timer.measure("selection");
        mGather.buildTree(mSamples);
    }
    for (int k = 0; k < input.view.levels() && !input.isInterrupted(); ++k) {
        const auto scope = timer.measure("splatting " + std::to_string(k));
        mGather.gather(k, input.view, mSamples, input.materials);
    }
}

void TiledBackend::finish(const SolveInput& input) {
    mAccumulation.accumulate(exitance(), input.view, input.materials);
}

} // namespace celadon
