#pragma once

#include "renderer/gather/gather_materials.h"
#include "renderer/gather/level_accumulation.h"
#include "renderer/gather/pixel_tiles.h"
#include "renderer/gather/sample_tree.h"
#include "renderer/gather/tile_gather.h"
#include "renderer/gather/view_level.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/splatting_settings.h"

#include <cstdint>
#include <optional>
#include <vector>

/// For software drivers, where a read-back is a copy and the processor is the renderer anyway: the
/// buffers' level 0 is read, tiles of pixels gather from a tree of samples on all cores, and only
/// the sums go back.
///
/// While the view stays as it is, as under a brush, tiles that no change of a light's samples or of
/// their own texels reaches keep what they had.
namespace celadon {

class CpuBackend final : public SplatBackend {
public:
    CpuBackend(const gl::ShaderLibrary& shaders, std::span<const MaterialPointer> materials,
               const SplattingBuffer& view, const SplattingSettings& settings);

    void begin(const SolveInput& input) override;
    void add(const SolveInput& input, const LightViews& lightViews, int view,
             gl::StageTimer& timer) override;
    void finish(const SolveInput& input) override;
    void materialChanged(const MaterialChange& change) override;
    [[nodiscard]] gl::Texture& exitance() override { return mExitance; }
    void count(FrameStats& statistics) override;

    /// Of the last light view, for views that explain.
    [[nodiscard]] const SampleTree& tree() const { return mLights[mLastLight].tree; }
    [[nodiscard]] LightTexels lightTexels() const { return lightTexels(mLights[mLastLight]); }
    /// Of the last solve, without those of tiles that were kept.
    [[nodiscard]] std::uint64_t gatheredPairs() const { return mGatheredPairs; }

private:
    /// What a light view brought, and from what.
    struct LightState {
        std::optional<blocks::LightBlock> drawnFor;
        std::uint64_t geometry = 0;             ///< SolveInput's then
        std::vector<std::vector<float>> texels; ///< the irradiance buffer's targets
        gl::Texture surfaces;                   ///< one of them, for new radii
        SampleTree tree;
        bool hasTree = false; ///< `tree` is of these texels, in the codes in use
        SampleTree before;    ///< see TreeChange
        std::vector<std::vector<float>> exitances; ///< [level], RGBA as ViewTexels
        std::vector<bool> isCurrent;               ///< [level]: gathered from `tree`
        std::vector<TexelChange> changes;          ///< of materials since
    };
    /// @return whether the surface that it shows is as it was
    bool drawLight(const blocks::LightBlock& light, const SolveInput& input, LightState& state);
    [[nodiscard]] LightTexels lightTexels(const LightState& state) const;
    /// @param before, changed  see SampleTree::build()
    void buildTree(const blocks::LightBlock& light, LightState& state, const SampleTree* before,
                   const ChangedTexels& changed);
    /// Since the sums were gathered.
    struct Since {
        const SampleTree& before;
        const ChangedTexels& changed;
    };
    void gather(LightState& state, const Since& since, const SolveInput& input,
                gl::StageTimer& timer);
    void readView(const SplattingBuffer& view);
    void accumulate(const SolveInput& input);

    SplattingSettings mSettings;
    IrradianceBuffer mIrradiance; ///< level 0 only
    GatherMaterials mMaterials;
    GatherSettings mGather;
    gl::Texture mExitance;
    glm::vec4 mObject{0.0f}; ///< bounding sphere of what scatters, of this solve, mm
    std::vector<ViewLevel> mView;
    std::vector<PixelTiles> mTiles; ///< of each level
    LevelAccumulation mAccumulation;
    std::uint64_t mViewDrawn = 0;    ///< SplattingBuffer::drawn() of mView
    bool mHasNewRadii = false;       ///< since mView was read
    glm::ivec4 mViewPart{0};         ///< SplattingBuffer::bounds() then
    glm::ivec4 mLitPart;             ///< of level 0: elsewhere mExitance is 0
    std::vector<LightState> mLights; ///< more light views take turns, and keep nothing
    std::size_t mLastLight = 0;
    std::uint64_t mGatheredPairs = 0;
    std::vector<float> mRadii; ///< read back
};

} // namespace celadon
