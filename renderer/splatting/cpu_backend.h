#pragma once

#include "renderer/gather/gather_materials.h"
#include "renderer/gather/sample_tree.h"
#include "renderer/gather/tile_gather.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/splatting_settings.h"

#include <vector>

/// For software drivers, where a read-back is a copy and the processor is the renderer anyway: the
/// buffers' level 0 is read, and tiles of pixels gather from a tree of samples on all cores.
namespace celadon {

class CpuBackend final : public SplatBackend {
public:
    CpuBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> materials,
               const SplattingBuffer& view, const SplattingSettings& settings);

    void begin(const SolveInput& input) override;
    void add(const SolveInput& input, const LightViews& lightViews, int view,
             gl::StageTimer& timer) override;
    void finish() override;
    void materialsChanged() override { mMaterials.update(); }
    [[nodiscard]] gl::Texture& exitance() override { return mExitance; }
    void count(FrameStats& statistics) override;

    /// Of the last light view, for views that explain.
    [[nodiscard]] const SampleTree& tree() const { return mTree; }
    [[nodiscard]] LightTexels lightTexels() const;

private:
    void buildTree(const blocks::LightBlock& light, const SolveInput& input);

    SplattingSettings mSettings;
    IrradianceBuffer mIrradiance; ///< level 0 only
    GatherMaterials mMaterials;
    SampleTree mTree;
    GatherSettings mGather;
    gl::Texture mExitance;
    std::vector<std::vector<float>> mLight; ///< the irradiance buffer's targets
    struct ViewLevel {
        std::vector<float> positions, surfaces, exitance;
    };
    std::vector<ViewLevel> mView;
};

} // namespace celadon
