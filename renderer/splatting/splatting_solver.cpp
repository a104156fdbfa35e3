#include "renderer/splatting/splatting_solver.h"

#include <array>
#include <cmath>
#include <string>

namespace celadon {

namespace {

constexpr double kClusterDepth = 0.01; ///< of R_w: depths of one surface in a median cluster
constexpr double kWattsPerUnit = 1e-6; ///< flux is kept in W/m^2 times mm^2

} // namespace

SplattingSolver::SplattingSolver(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                                 const SplattingBuffer& view, const SplattingSettings& settings)
    : mSettings(settings),
      mIrradiance(shaders, materials.count(), settings.irradianceSize,
                  settings.adaptive ? settings.irradianceLevels : 1),
      mSelection(shaders, mIrradiance),
      mSplat(shaders, materials, view),
      mAccumulation(shaders, materials.count()),
      mSolveBlock("solve", sizeof(blocks::SolveBlock), gl::BufferUse::Update) {
    if (!materials.isHomogeneous() && mIrradiance.levels() > 1) {
        mProfiles.emplace(shaders, mIrradiance, materials.count(), materials.nodeSegments());
    }
}

void SplattingSolver::writeSolveBlock(const SolveInput& input) {
    const double radius = input.world.scatteringSphere.radius;
    blocks::SolveBlock block;
    block.selection = glm::vec4(mSettings.alpha, mSettings.discontinuity * radius, 2.0 * radius, 0.0);
    block.node = glm::vec4(input.materials.largestRadiusMm(),
                           float(input.materials.nodeSegments()), 0.0f, 0.0f);
    block.rings = glm::vec4(float(viewLevels()), float(mIrradiance.levels()), 0.0f, 0.0f);
    block.energy = glm::vec4(mSettings.energy < 1.0 ? 1.0f : 0.0f, mSettings.adaptive ? 1.0f : 0.0f,
                             mSettings.multiresolution ? 1.0f : 0.0f, 0.0f);
    mSolveBlock.write(std::array{block});
    mSolveBlock.bindUniform(blocks::kSolve);
}

const gl::Texture& SplattingSolver::solve(const SolveInput& input, gl::StageTimer& timer) {
    mStatistics = {};
    mStatistics.samples.selected.assign(static_cast<std::size_t>(mIrradiance.levels()), 0);
    const double diameter = 2.0 * input.world.scatteringSphere.radius;
    writeSolveBlock(input);
    {
        const auto scope = timer.measure("splattingBuffer");
        input.view.buildMips(kClusterDepth * diameter);
        mSplat.clear();
    }
    for (const Light& light : input.lights) {
        for (const LightView& lightView :
             makeLightViews(light, input.world.scatteringSphere, input.world.sceneSphere,
                            mIrradiance.size())) {
            {
                const auto scope = timer.measure("irradianceBuffer");
                mIrradiance.draw(input.gpuWorld, lightView);
                mIrradiance.buildMips();
                if (mProfiles) {
                    mProfiles->build(mIrradiance, static_cast<float>(mSettings.energy));
                }
            }
            {
                const auto scope = timer.measure("selection");
                mSelection.select(mIrradiance);
            }
            for (int k = 0; k < viewLevels(); ++k) {
                const auto scope = timer.measure("splatting " + std::to_string(k));
                mSplat.splat(k, input.view, mIrradiance, mProfiles ? &*mProfiles : nullptr,
                             mSelection, input.materials);
            }
            if (mCollect) {
                gatherStatistics();
            }
            if (mObserver) {
                mObserver();
            }
        }
    }
    if (mCollect) {
        double pairs = 0.0;
        for (int k = 0; k < viewLevels(); ++k) {
            const std::vector<float> texels = mSplat.exitance().readLevel(k);
            for (std::size_t i = 3; i < texels.size(); i += 4) {
                pairs += static_cast<double>(texels[i]);
            }
        }
        mStatistics.samples.pairs = static_cast<std::uint64_t>(std::llround(pairs));
    }
    {
        const auto scope = timer.measure("accumulation");
        const double depth =
            glm::dot(input.world.scatteringSphere.center - input.camera.eye, input.camera.frame.forward);
        mAccumulation.accumulate(mSplat.exitance(), input.view, input.materials,
                                 input.camera.pixelWidth, std::max(depth, 1e-3));
    }
    return mSplat.exitance();
}

void SplattingSolver::gatherStatistics() {
    for (int level = 0; level < mIrradiance.levels(); ++level) {
        const std::vector<float> flux = mIrradiance.fluxes().readLevel(level);
        for (std::size_t i = 0; i < flux.size(); i += 4) {
            if (flux[i] + flux[i + 1] + flux[i + 2] > 0.0f) {
                ++mStatistics.samples.candidates;
            }
            for (std::size_t c = 0; level == 0 && c < 3; ++c) {
                mStatistics.flux.lit[c] += static_cast<double>(flux[i + c]) * kWattsPerUnit;
            }
        }
        const std::vector<std::int32_t> selected = mSelection.readIndices(level);
        mStatistics.samples.selected[static_cast<std::size_t>(level)] += selected.size();
        for (const std::int32_t index : selected) {
            for (std::size_t c = 0; c < 3; ++c) {
                mStatistics.flux.selected[c] +=
                    static_cast<double>(flux[static_cast<std::size_t>(index) * 4 + c]) * kWattsPerUnit;
            }
        }
    }
}

void SplattingSolver::report(FrameStats& stats) {
    stats.samples = mStatistics.samples;
    stats.flux = mStatistics.flux;
}

} // namespace celadon
