#include "renderer/splatting/splatting_solver.h"

#include <algorithm>
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
      mSelection(shaders, mIrradiance, settings.scheme),
      mSplat(shaders, materials, view, settings.scheme),
      mAccumulation(shaders, materials.count()),
      mSolveBlock("solve", sizeof(blocks::SolveBlock), gl::BufferUse::Update) {
    if (!materials.isHomogeneous() && mIrradiance.levels() > 1) {
        mProfiles.emplace(shaders, mIrradiance, materials.count(), materials.nodeSegments());
    }
    if (settings.scheme == Scheme::Hierarchical) {
        mBalls.emplace(shaders, mIrradiance);
    }
}

void SplattingSolver::writeSolveBlock(const SolveInput& input) {
    const double radius = input.world.scatteringSphere.radius;
    blocks::SolveBlock block;
    block.selection =
        glm::vec4(mSettings.alpha, mSettings.discontinuity * radius, 2.0 * radius, 0.0);
    block.node = glm::vec4(input.materials.largestRadiusMm(), float(input.materials.nodeSegments()),
                           float(mSettings.sampleAngle), float(mSettings.fineSpread));
    block.rings = glm::vec4(float(viewLevels()), float(mIrradiance.levels()),
                            float(mSettings.pixelAngle), float(mSettings.fade));
    block.energy = glm::vec4(mSettings.energy < 1.0 ? 1.0f : 0.0f, mSettings.adaptive ? 1.0f : 0.0f,
                             mSettings.multiresolution ? 1.0f : 0.0f, 0.0f);
    mSolveBlock.write(std::array{block});
    mSolveBlock.bindUniform(blocks::kSolve);
}

std::vector<double> SplattingSolver::ringStarts(const SolveInput& input) const {
    const double depth = std::max(glm::dot(input.world.scatteringSphere.center - input.camera.eye,
                                           input.camera.frame.forward),
                                  1e-3);
    const double pixel = input.camera.pixelWidth.atDepthMm(depth);
    const double R_P = static_cast<double>(input.materials.meanRadiusMm());
    std::vector<double> starts(static_cast<std::size_t>(viewLevels()), 0.0);
    for (int k = 1; k < viewLevels(); ++k) {
        const double width = pixel * (1 << k);
        starts[static_cast<std::size_t>(k)] =
            mSettings.scheme == Scheme::Hierarchical
                ? width / mSettings.pixelAngle
                : R_P * static_cast<double>(input.materials.minimalRadius(float(R_P / width)));
    }
    return starts;
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
                if (mBalls) {
                    mBalls->build(mIrradiance);
                }
            }
            const NodeProfiles* profiles = mProfiles ? &*mProfiles : nullptr;
            const NodeBalls* balls = mBalls ? &*mBalls : nullptr;
            for (int k = 0; k < viewLevels(); ++k) {
                if (input.isInterrupted()) {
                    return mSplat.exitance();
                }
                if (k == 0 || balls != nullptr) {
                    const auto scope = timer.measure("selection");
                    mSelection.select(mIrradiance, balls, k);
                }
                const auto scope = timer.measure("splatting " + std::to_string(k));
                mSplat.splat(k, input.view, mIrradiance, profiles, balls, mSelection,
                             input.materials);
            }
            if (mCollect) {
                if (balls != nullptr) {
                    mSelection.select(mIrradiance, balls, SampleSelection::kAnyRing);
                }
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
        mAccumulation.accumulate(mSplat.exitance(), input.view, ringStarts(input));
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
        // Hierarchical: nodes share a texel's flux by distance. Close by, it is all with the one
        // ancestor that has no ball (DESIGN 3.2: the weights sum to one).
        const std::vector<float> balls =
            mBalls ? mBalls->radii().readLevel(level) : std::vector<float>();
        mStatistics.samples.selected[static_cast<std::size_t>(level)] += selected.size();
        for (const std::int32_t index : selected) {
            if (mBalls && balls[static_cast<std::size_t>(index)] > 0.0f) {
                continue;
            }
            for (std::size_t c = 0; c < 3; ++c) {
                mStatistics.flux.selected[c] +=
                    static_cast<double>(flux[static_cast<std::size_t>(index) * 4 + c]) *
                    kWattsPerUnit;
            }
        }
    }
}

void SplattingSolver::report(FrameStats& stats) {
    stats.samples = mStatistics.samples;
    stats.flux = mStatistics.flux;
}

} // namespace celadon
