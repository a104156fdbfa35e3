#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/splatting/accumulation.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/node_balls.h"
#include "renderer/splatting/node_profiles.h"
#include "renderer/splatting/raster_splat.h"
#include "renderer/splatting/sample_selection.h"
#include "renderer/splatting/splatting_settings.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// Multiresolution splatting (Chen et al. 2012): the four steps, four calls.
namespace celadon {

class SplattingSolver final : public ExitanceSolver {
public:
    /// @param view already of viewLevels(settings) levels
    SplattingSolver(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                    const SplattingBuffer& view, const SplattingSettings& settings);

    [[nodiscard]] static int viewLevels(const SplattingSettings& settings) {
        return settings.multiresolution ? settings.splattingLevels : 1;
    }
    [[nodiscard]] int viewLevels() const override { return viewLevels(mSettings); }
    const gl::Texture& solve(const SolveInput& input, gl::StageTimer& timer) override;
    void report(FrameStats& stats) override;

    /// The buffers of the last light view, for tests and for views that explain.
    [[nodiscard]] const IrradianceBuffer& irradianceBuffer() const { return mIrradiance; }
    [[nodiscard]] const SampleSelection& selection() const { return mSelection; }
    [[nodiscard]] const NodeProfiles* nodeProfiles() const {
        return mProfiles ? &*mProfiles : nullptr;
    }
    /// Called within solve() for each light view once its samples are selected and splatted.
    void observeLightViews(std::function<void()> observer) { mObserver = std::move(observer); }
    /// Counts of samples and flux are gathered while solving; off by default since it reads back.
    void collectStatistics(bool on) { mCollect = on; }

private:
    void writeSolveBlock(const SolveInput& input);
    [[nodiscard]] std::vector<double> ringStarts(const SolveInput& input) const;
    void gatherStatistics();

    SplattingSettings mSettings;
    IrradianceBuffer mIrradiance;
    std::optional<NodeProfiles> mProfiles;
    std::optional<NodeBalls> mBalls; ///< hierarchical
    SampleSelection mSelection;
    RasterSplat mSplat;
    Accumulation mAccumulation;
    gl::Buffer mSolveBlock;
    std::function<void()> mObserver;
    bool mCollect = false;
    FrameStats mStatistics;
};

} // namespace celadon
