#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/gl/context.h"
#include "renderer/splatting/cpu_backend.h"
#include "renderer/splatting/light_views.h"
#include "renderer/splatting/raster_backend.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/splatting_settings.h"

#include <memory>
#include <span>

/// Multiresolution splatting (Chen et al. 2012): the four steps, four calls.
namespace celadon {

/// N: settings.irradianceSize, or two or four times as much where R_P spans so few texels that the
/// light view itself is the largest error, and it is to be refined.
/// @param shortRadiusMm R_P of what is lit, where it is short; @param R_w in mm
[[nodiscard]] int refinedIrradianceSize(const SplattingSettings& settings, double shortRadiusMm,
                                        double R_w);
/// Where ranges are shorter than a few texels of even that, patches are spread until they no longer
/// show as a lattice: what scatters as good as nowhere looks opaque, and smooth.
/// @param settings with the refined size
[[nodiscard]] double refinedPatchVariance(const SplattingSettings& settings, double shortRadiusMm,
                                          double R_w);

class SplattingSolver final : public ExitanceSolver {
public:
    /// @param view already of viewLevels(settings) levels
    /// @param shaders, maps, materials, view outlive the solver
    /// @param settings with backend Auto the first solve() measures raster and tiled, and stays
    ///        with the faster; so do later solvers of the same scheme in this process
    SplattingSolver(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> maps,
                    const GpuMaterials& materials, const SplattingBuffer& view,
                    const SplattingSettings& settings);

    [[nodiscard]] static int viewLevels(const SplattingSettings& settings) {
        return settings.multiresolution ? settings.splattingLevels : 1;
    }
    [[nodiscard]] int viewLevels() const override { return viewLevels(mSettings); }
    const gl::Texture& solve(const SolveInput& input, gl::StageTimer& timer) override;
    void report(FrameStats& stats) override;
    void materialChanged(const MaterialChange& change) override;

    /// Never Auto once something was solved.
    [[nodiscard]] SplatBackendKind backend() const { return mSettings.backend; }

    /// The raster backend and its buffers, for tests and views that explain; else null.
    [[nodiscard]] RasterBackend* raster() { return dynamic_cast<RasterBackend*>(mBackend.get()); }
    /// The cpu backend, for views that explain; else null.
    [[nodiscard]] const CpuBackend* cpu() const {
        return dynamic_cast<const CpuBackend*>(mBackend.get());
    }
    /// Counts of samples and flux are gathered while solving; off by default since it reads back.
    void collectStatistics(bool on) { mCollect = on; }

private:
    void makeBackend();
    void chooseBackend(const SolveInput& input, const gl::StageTimer& timer);
    SplatBackendKind measureFaster(const SolveInput& input, const gl::StageTimer& timer);
    void solveOnce(const SolveInput& input, gl::StageTimer& timer);
    void writeSolveBlock(const SolveInput& input);
    [[nodiscard]] int irradianceLevels() const {
        return mSettings.adaptive ? mSettings.irradianceLevels : 1;
    }
    void countPairs();

    const gl::ShaderLibrary& mShaders;
    std::span<const MaterialPointer> mMaps;
    const GpuMaterials& mMaterials;
    const SplattingBuffer& mView;
    SplattingSettings mSettings;
    std::unique_ptr<SplatBackend> mBackend; ///< null while Auto
    LightViews mLightViews;
    gl::Buffer mSolveBlock;
    bool mCollect = false;
    FrameStats mStatistics;
};

/// What Auto means on a driver; Auto again where that must be measured.
[[nodiscard]] SplatBackendKind resolveBackend(SplatBackendKind kind, const gl::Context& context);

} // namespace celadon
