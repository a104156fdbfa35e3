#include "renderer/splatting/splatting_solver.h"

#include "renderer/splatting/cpu_backend.h"
#include "renderer/splatting/raster_backend.h"
#include "renderer/splatting/tiled_backend.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <utility>

namespace celadon {

SplatBackendKind resolveBackend(SplatBackendKind kind, const gl::Context& context) {
    return kind == SplatBackendKind::Auto && context.isSoftware() ? SplatBackendKind::Cpu : kind;
}

int refinedIrradianceSize(const SplattingSettings& settings, double shortRadiusMm, double R_w) {
    const double texels = settings.irradianceSize * shortRadiusMm / R_w;
    return settings.irradianceSize * (texels < settings.finerBelowTexels  ? 4
                                      : texels < settings.fineBelowTexels ? 2
                                                                          : 1);
}

double refinedPatchVariance(const SplattingSettings& settings, double shortRadiusMm, double R_w) {
    if (settings.finerBelowTexels <= 0.0 || settings.scheme != Scheme::Hierarchical) {
        return settings.patchVariance;
    }
    // Patches s texels wide ripple by 2 e^(-2 pi^2 s^2): 40 % at 1/12, 1.4 % at three times that.
    constexpr double kSpread = 3.0;
    constexpr double kAll = 2.0; // texels of a range that hides nothing of the lattice by itself
    const double texels = settings.irradianceSize * shortRadiusMm / R_w;
    const double wanted =
        std::lerp(kSpread, 1.0, std::clamp((texels - kAll) / (kLatticeTexels - kAll), 0.0, 1.0));
    return std::max(settings.patchVariance, wanted);
}

SplattingSolver::SplattingSolver(const gl::ShaderLibrary& shaders,
                                 std::span<const MaterialPointer> maps,
                                 const GpuMaterials& materials, const SplattingBuffer& view,
                                 const SplattingSettings& settings)
    : mShaders(shaders),
      mMaps(maps),
      mMaterials(materials),
      mView(view),
      mSettings(settings),
      mLightViews(shaders, LightViews::Target::Scattering, settings.irradianceSize),
      mSolveBlock("solve", sizeof(blocks::SolveBlock), gl::BufferUse::Update) {
    if (settings.scheme == Scheme::Hierarchical) {
        mSettings.energy = 1.0; // nothing is cut, so nothing is given back
    }
    if (settings.backend != SplatBackendKind::Auto) {
        makeBackend();
    }
}

void SplattingSolver::makeBackend() {
    switch (mSettings.backend) {
    case SplatBackendKind::Cpu:
        mBackend = std::make_unique<CpuBackend>(mShaders, mMaps, mView, mSettings);
        break;
    case SplatBackendKind::Tiled:
        mBackend = std::make_unique<TiledBackend>(mShaders, mMaps, mMaterials, mView, mSettings);
        break;
    case SplatBackendKind::Auto:
    case SplatBackendKind::Raster:
        mBackend = std::make_unique<RasterBackend>(mShaders, mMaterials, mView, mSettings);
        break;
    }
}

void SplattingSolver::chooseBackend(const SolveInput& input, const gl::StageTimer& timer) {
    static std::mutex mutex;
    static std::map<Scheme, SplatBackendKind> choices;
    const std::scoped_lock lock(mutex);
    auto choice = choices.find(mSettings.scheme);
    if (choice == choices.end()) {
        choice = choices.emplace(mSettings.scheme, measureFaster(input, timer)).first;
    }
    mSettings.backend = choice->second;
    makeBackend();
}

SplatBackendKind SplattingSolver::measureFaster(const SolveInput& input,
                                                const gl::StageTimer& timer) {
    using Clock = std::chrono::steady_clock;
    constexpr int kSolves = 3; // of each; the first warms up
    SolveInput whole = input;
    whole.interrupt = nullptr;
    gl::StageTimer unread = timer.sibling();
    const bool collect = std::exchange(mCollect, false);
    SplatBackendKind faster = SplatBackendKind::Raster;
    Clock::duration least = Clock::duration::max();
    for (const SplatBackendKind kind : {SplatBackendKind::Raster, SplatBackendKind::Tiled}) {
        mSettings.backend = kind;
        makeBackend();
        for (int i = 0; i < kSolves; ++i) {
            glFinish();
            const Clock::time_point begin = Clock::now();
            solveOnce(whole, unread);
            glFinish();
            const Clock::duration elapsed = Clock::now() - begin;
            if (i > 0 && elapsed < least) {
                least = elapsed;
                faster = kind;
            }
        }
    }
    mCollect = collect;
    return faster;
}

void SplattingSolver::writeSolveBlock(const SolveInput& input) {
    blocks::SolveBlock block;
    block.selection =
        glm::vec4(mSettings.alpha, mSettings.discontinuity, 0.0, mSettings.orientation ? 1.0 : 0.0);
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
    if (!mBackend) {
        chooseBackend(input, timer);
    }
    solveOnce(input, timer);
    return mBackend->exitance();
}

void SplattingSolver::solveOnce(const SolveInput& input, gl::StageTimer& timer) {
    mStatistics = {};
    mStatistics.samples.selected.assign(static_cast<std::size_t>(irradianceLevels()), 0);
    writeSolveBlock(input);
    {
        const auto scope = timer.measure("splattingBuffer");
        mBackend->begin(input);
    }
    mLightViews.update(input.lights, input.gpuWorld);
    for (int view = 0; view < mLightViews.count(); ++view) {
        if (input.isInterrupted()) {
            return;
        }
        const LightViews::Scope whereUsed = mLightViews.whereUsed(view);
        mLightViews.bind(view);
        mBackend->add(input, mLightViews, view, timer);
        if (mCollect && mLightViews.isUsed(view)) {
            mBackend->count(mStatistics);
        }
    }
    if (input.isInterrupted()) {
        return;
    }
    const auto scope = timer.measure("accumulation");
    mBackend->finish(input);
    if (mCollect) {
        countPairs();
    }
}

void SplattingSolver::materialChanged(const MaterialChange& change) {
    if (mBackend) {
        mBackend->materialChanged(change);
    }
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
