#pragma once

#include "renderer/output/frame_stats.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/node_balls.h"
#include "renderer/splatting/node_profiles.h"
#include "renderer/splatting/sample_selection.h"
#include "renderer/splatting/splatting_settings.h"

#include <optional>

/// What the backends on the GPU splat: the irradiance buffer of a light view with all that its
/// nodes need, at the level of detail that the settings ask for.
namespace celadon {

class GpuSamples {
public:
    GpuSamples(const gl::ShaderLibrary& shaders, const GpuMaterials& materials,
               const SplattingSettings& settings);

    /// Draws a light view and builds its pyramid. The blocks are bound as SplatBackend::add says.
    void build(const GpuWorld& world);
    /// Selects what takes part in a ring of the splatting levels.
    void select(int splattingLevel) { mSelection.select(mBuffer, balls(), splattingLevel); }
    /// Adds what `--stats` says of this light view. Reads back.
    void count(FrameStats& statistics);

    /// To the texture units of include/node_splat.glsl.
    void bindNodes() const;

    [[nodiscard]] const IrradianceBuffer& buffer() const { return mBuffer; }
    [[nodiscard]] const NodeProfiles* profiles() const { return mProfiles ? &*mProfiles : nullptr; }
    /// Hierarchical scheme only.
    [[nodiscard]] const NodeBalls* balls() const { return mBalls ? &*mBalls : nullptr; }
    [[nodiscard]] const SampleSelection& selection() const { return mSelection; }

private:
    float mCutEnergy;
    IrradianceBuffer mBuffer;
    std::optional<NodeProfiles> mProfiles; ///< not where one profile is everywhere
    std::optional<NodeBalls> mBalls;
    SampleSelection mSelection;
};

} // namespace celadon
