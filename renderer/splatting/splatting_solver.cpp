#include "renderer/splatting/splatting_solver.h"

#include "renderer/splatting/cpu_backend.h"
#include "renderer/splatting/raster_backend.h"
#include "subedit/assert.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

constexpr double kClusterDepth = 0.01; ///< of R_w: depths of one surface in a median cluster

} // namespace

SplatBackendKind resolveBackend(SplatBackendKind kind, const gl::Context& context) {
    if (kind != SplatBackendKind::Auto) {
        return kind;
    }
    return context.isSoftware() ? SplatBackendKind::Cpu : SplatBackendKind::Raster;
}

int refinedIrradianceSize(const SplattingSettings& settings, double shortRadiusMm, double R_w) {
    // Below, silhouettes and shadows of the light view err by more than 1 % of what is seen.
    constexpr double kTexelsPerRadius = 15.0;
    const double texels = settings.irradianceSize * shortRadiusMm / R_w;
    return settings.refineShortRanges && texels < kTexelsPerRadius ? 2 * settings.irradianceSize
                                                                   : settings.irradianceSize;
}

SplattingSolver::SplattingSolver(const gl::ShaderLibrary& shaders,
                                 std::span<const MaterialPointer> maps,
                                 const GpuMaterials& materials, const SplattingBuffer& view,
                                 const SplattingSettings& settings)
    : mSettings(settings),
      mAccumulation(shaders, materials.count()),
      mSolveBlock("solve", sizeof(blocks::SolveBlock), gl::BufferUse::Update) {
    CELADON_ASSERT(settings.backend != SplatBackendKind::Auto);
    if (settings.backend == SplatBackendKind::Cpu) {
        mBackend = std::make_unique<CpuBackend>(shaders, maps, view, settings);
    } else {
        mBackend = std::make_unique<RasterBackend>(shaders, materials, view, settings);
    }
}

void SplattingSolver::writeSolveBlock(const SolveInput& input) {
    const double radius = input.world.scatteringSphere.radius;
    blocks::SolveBlock block;
    block.selection =
        glm::vec4(mSettings.alpha, mSettings.discontinuity * radius, 2.0 * radius, 0.0);
    const gather::Knots& knots = input.materials.commonKnots();
    block.node = glm::vec4(knots.rangeMm, float(knots.segments), float(mSettings.sampleAngle),
                           float(mSettings.fineSpread));
    block.rings = glm::vec4(float(viewLevels()), float(irradianceLevels()),
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
    mStatistics.samples.selected.assign(static_cast<std::size_t>(irradianceLevels()), 0);
    const double diameter = 2.0 * input.world.scatteringSphere.radius;
    writeSolveBlock(input);
    {
        const auto scope = timer.measure("splattingBuffer");
        input.view.buildMips(kClusterDepth * diameter);
        mBackend->begin(input);
    }
    for (const Light& light : input.lights) {
        for (const LightView& lightView :
             makeLightViews(light, input.world.scatteringSphere, input.world.sceneSphere,
                            mSettings.irradianceSize)) {
            if (input.isInterrupted()) {
                return mBackend->exitance();
            }
            mBackend->add(input, lightView, timer);
            if (mCollect) {
                mBackend->count(mStatistics);
            }
        }
    }
    const auto scope = timer.measure("accumulation");
    mBackend->finish();
    if (mCollect) {
        countPairs();
    }
    mAccumulation.accumulate(mBackend->exitance(), input.view, ringStarts(input));
    return mBackend->exitance();
}

void SplattingSolver::countPairs() {
    double pairs = 0.0;
    for (int k = 0; k < viewLevels(); ++k) {
        const std::vector<float> texels = mBackend->exitance().readLevel(k);
        for (std::size_t i = 3; i < texels.size(); i += 4) {
            pairs += static_cast<double>(texels[i]);
        }
    }
    mStatistics.samples.pairs = static_cast<std::uint64_t>(std::llround(pairs));
}

void SplattingSolver::report(FrameStats& stats) {
    stats.samples = mStatistics.samples;
    stats.flux = mStatistics.flux;
}

} // namespace celadon
