#include "renderer/splatting/gpu_samples.h"

namespace celadon {

namespace {

constexpr double kWattsPerUnit = 1e-6; ///< flux is kept in W/m^2 times mm^2

} // namespace

GpuSamples::GpuSamples(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                       const SplattingSettings& settings)
    : mCutEnergy(static_cast<float>(settings.energy)),
      mBuffer(shaders, materials.count(), settings.irradianceSize,
              settings.adaptive ? settings.irradianceLevels : 1, settings.patchVariance),
      mSelection(shaders, mBuffer, settings.scheme) {
    if (!materials.isHomogeneous() && mBuffer.levels() > 1) {
        mProfiles.emplace(shaders, mBuffer, materials.count(), materials.commonKnots().segments);
    }
    if (settings.scheme == Scheme::Hierarchical) {
        mBalls.emplace(shaders, mBuffer);
    }
}

void GpuSamples::build(const GpuWorld& world) {
    mBuffer.draw(world);
    mBuffer.buildMips();
    if (mProfiles) {
        mProfiles->build(mBuffer, mCutEnergy);
    }
    if (mBalls) {
        mBalls->build(mBuffer);
    }
}

void GpuSamples::bindNodes() const {
    mBuffer.positions().bind(0);
    mBuffer.fluxes().bind(1);
    mBuffer.surfaces().bind(2);
    mBuffer.covariances().bind(3);
    mBuffer.extents().bind(4);
    mBuffer.kepts().bind(5);
    if (mProfiles) {
        mProfiles->profiles().bind(7);
    }
    if (mBalls) {
        mBalls->radii().bind(27);
    }
}

void GpuSamples::count(FrameStats& statistics) {
    select(SampleSelection::kAnyRing);
    for (int level = 0; level < mBuffer.levels(); ++level) {
        const std::vector<float> flux = mBuffer.fluxes().readLevel(level);
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
        const std::vector<float> radii =
            mBalls ? mBalls->radii().readLevel(level) : std::vector<float>();
        statistics.samples.selected[static_cast<std::size_t>(level)] += selected.size();
        for (const std::int32_t index : selected) {
            if (mBalls && radii[static_cast<std::size_t>(index)] > 0.0f) {
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
