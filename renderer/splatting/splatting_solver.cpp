#include "renderer/splatting/splatting_solver.h"

#include "renderer/splatting/cpu_backend.h"
#include "renderer/splatting/raster_backend.h"
#include "subedit/assert.h"

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
    if (!settings.refineShortRanges) {
        return settings.irradianceSize;
    }
    // Below 15, silhouettes and shadows of the light view err by more than 1 % of what is seen;
    // below 3 or 4 the texels themselves begin to show, as a lattice.
    const double texels = settings.irradianceSize * shortRadiusMm / R_w;
    return settings.irradianceSize * (texels < 3.75 ? 4 : texels < 15.0 ? 2 : 1);
}

SplattingSolver::SplattingSolver(const gl::ShaderLibrary& shaders,
                                 std::span<const MaterialPointer> maps,
                                 const GpuMaterials& materials, const SplattingBuffer& view,
                                 const SplattingSettings& settings)
    : mSettings(settings),
      mLightViews(shaders, LightViews::Target::Scattering, settings.irradianceSize),
      mAccumulation(shaders, materials.count(), settings.scheme, view),
      mSolveBlock("solve", sizeof(blocks::SolveBlock), gl::BufferUse::Update) {
    CELADON_ASSERT(settings.backend != SplatBackendKind::Auto);
    if (settings.backend == SplatBackendKind::Cpu) {
        mBackend = std::make_unique<CpuBackend>(shaders, maps, view, settings);
    } else {
        mBackend = std::make_unique<RasterBackend>(shaders, materials, view, settings);
    }
}

void SplattingSolver::writeSolveBlock(const SolveInput& input) {
    blocks::SolveBlock block;
    block.selection = glm::vec4(mSettings.alpha, mSettings.discontinuity, 0.0,
                                mSettings.orientation ? 1.0 : 0.0);
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

const gl::Texture& SplattingSolver::solve(const SolveInput& input, gl::StageTimer& timer) {
    mStatistics = {};
    mStatistics.samples.selected.assign(static_cast<std::size_t>(irradianceLevels()), 0);
    writeSolveBlock(input);
    {
        const auto scope = timer.measure("splattingBuffer");
        input.view.buildMips(kClusterDepth);
        mBackend->begin(input);
    }
    mLightViews.update(input.lights, input.gpuWorld);
    for (int view = 0; view < mLightViews.count(); ++view) {
        if (input.isInterrupted()) {
            return mBackend->exitance();
        }
        const LightViews::Scope whereUsed = mLightViews.whereUsed(view);
        mLightViews.bind(view);
        mBackend->add(input, mLightViews, view, timer);
        if (mCollect && mLightViews.isUsed(view)) {
            mBackend->count(mStatistics);
        }
    }
    const auto scope = timer.measure("accumulation");
    mBackend->finish();
    if (mCollect) {
        countPairs();
    }
    mAccumulation.accumulate(mBackend->exitance(), input.view, input.materials);
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
