#pragma once

#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/node_balls.h"
#include "renderer/splatting/node_profiles.h"
#include "renderer/splatting/raster_splat.h"
#include "renderer/splatting/sample_selection.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/splatting_settings.h"

#include <functional>
#include <optional>
#include <utility>

/// The paper's way, all of it on the GPU: mips, selection in the vertex shader, splats grown in the
/// geometry shader, blending.
namespace celadon {

class RasterBackend final : public SplatBackend {
public:
    RasterBackend(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
                  const SplattingBuffer& view, const SplattingSettings& settings);

    void begin(const SolveInput& input) override;
    void add(const SolveInput& input, const LightViews& lightViews, int view,
             gl::StageTimer& timer) override;
    [[nodiscard]] gl::Texture& exitance() override { return mSplat.exitance(); }
    void count(FrameStats& statistics) override;

    /// The buffers of the last light view, for tests and for views that explain.
    [[nodiscard]] const IrradianceBuffer& irradianceBuffer() const { return mIrradiance; }
    [[nodiscard]] const SampleSelection& selection() const { return mSelection; }
    [[nodiscard]] const NodeProfiles* nodeProfiles() const {
        return mProfiles ? &*mProfiles : nullptr;
    }
    /// Called for each light view once its samples are selected and splatted.
    void observeLightViews(std::function<void()> observer) { mObserver = std::move(observer); }

private:
    SplattingSettings mSettings;
    IrradianceBuffer mIrradiance;
    std::optional<NodeProfiles> mProfiles;
    std::optional<NodeBalls> mBalls; ///< hierarchical
    SampleSelection mSelection;
    RasterSplat mSplat;
    std::function<void()> mObserver;
};

} // namespace celadon
