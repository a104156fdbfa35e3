#include "renderer/splatting/raster_backend.h"

#include <string>

namespace celadon {

namespace {

constexpr double kWattsPerUnit = 1e-6; ///< flux is kept in W/m^2 times mm^2

} // namespace

RasterBackend::RasterBackend(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                             const SplattingBuffer& view, const SplattingSettings& settings)
    : mSettings(settings),
      mIrradiance(shaders, materials.count(), settings.irradianceSize,
                  settings.adaptive ? settings.irradianceLevels : 1),
      mSelection(shaders, mIrradiance, settings.scheme),
      mSplat(shaders, materials, view, settings.scheme) {
    if (!materials.isHomogeneous() && mIrradiance.levels() > 1) {
        mProfiles.emplace(shaders, mIrradiance, materials.count(),
                          materials.commonKnots().segments);
    }
    if (settings.scheme == Scheme::Hierarchical) {
        mBalls.emplace(shaders, mIrradiance);
    }
}

void RasterBackend::begin(const SolveInput& input) {
    input.view.buildTileRanges();
    mSplat.clear();
}

void RasterBackend::add(const SolveInput& input, const LightViews& lightViews, int view,
                        gl::StageTimer& timer) {
    {
        const auto scope = timer.measure("irradianceBuffer");
        mIrradiance.draw(input.gpuWorld);
        mIrradiance.buildMips();
        if (mProfiles) {
            mProfiles->build(mIrradiance, static_cast<float>(mSettings.energy));
        }
        if (mBalls) {
            mBalls->build(mIrradiance);
        }
    }
    const NodeProfiles* profiles = mProfiles ? &*mProfiles : nullptr;
    const NodeBalls* balls = mBalls ? &*mBalls : nullptr;
    for (int k = 0; k < input.view.levels() && !input.isInterrupted(); ++k) {
        if (k == 0 || balls != nullptr) {
            const auto scope = timer.measure("selection");
            mSelection.select(mIrradiance, balls, k);
        }
        const auto scope = timer.measure("splatting " + std::to_string(k));
        mSplat.splat(k, input.view, mIrradiance, profiles, balls, mSelection, input.materials);
    }
    if (mObserver && lightViews.isUsed(view)) {
        mObserver();
    }
}

void RasterBackend::count(FrameStats& statistics) {
    if (mBalls) {
        mSelection.select(mIrradiance, &*mBalls, SampleSelection::kAnyRing);
    }
    for (int level = 0; level < mIrradiance.levels(); ++level) {
        const std::vector<float> flux = mIrradiance.fluxes().readLevel(level);
        for (std::size_t i = 0; i < flux.size(); i += 4) {
            if (flux[i] + flux[i + 1] + flux[i + 2] > 0.0f) {
                ++statistics.samples.candidates;
            }
            for (std::size_t c = 0; level == 0 && c < 3; ++c) {
                statistics.flux.lit[c] += static_cast<double>(flux[i + c]) * kWattsPerUnit;
            }
        }
        const std::vector<std::int32_t> selected = mSelection.readIndices(level);
        // Hierarchical: nodes share a texel's flux by distance. Close by, it is all with the one
        // ancestor that has no ball (DESIGN 3.2: the weights sum to one).
        const std::vector<float> balls =
            mBalls ? mBalls->radii().readLevel(level) : std::vector<float>();
        statistics.samples.selected[static_cast<std::size_t>(level)] += selected.size();
        for (const std::int32_t index : selected) {
            if (mBalls && balls[static_cast<std::size_t>(index)] > 0.0f) {
                continue;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                statistics.flux.selected[c] +=
                    static_cast<double>(flux[static_cast<std::size_t>(index) * 4 + c]) *
                    kWattsPerUnit;
            }
        }
    }
}

} // namespace celadon
