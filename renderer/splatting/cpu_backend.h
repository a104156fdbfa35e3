#pragma once

#include "renderer/gather/gather_materials.h"
#include "renderer/gather/sample_tree.h"
#include "renderer/gather/tile_gather.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/splat_backend.h"
#include "renderer/splatting/splatting_settings.h"

#include <cstdint>
#include <optional>
#include <vector>

/// For software drivers, where a read-back is a copy and the processor is the renderer anyway: the
/// buffers' level 0 is read, and tiles of pixels gather from a tree of samples on all cores.
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
    void finish() override;
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
    void buildTree(const blocks::LightBlock& light, const SolveInput& input, LightState& state,
                   const SampleTree* before, const ChangedTexels& changed);
    /// Since the sums were gathered.
    struct Since {
        const SampleTree& before;
        const ChangedTexels& changed;
    };
    void gather(LightState& state, const Since& since, const SolveInput& input,
                gl::StageTimer& timer);

    SplattingSettings mSettings;
    IrradianceBuffer mIrradiance; ///< level 0 only
    GatherMaterials mMaterials;
    GatherSettings mGather;
    gl::Texture mExitance;
    struct ViewLevel {
        glm::ivec4 part; ///< x, y, width, height: of this is the rest
        std::vector<float> positions, surfaces, exitance;
        PixelTiles tiles;

        [[nodiscard]] ViewTexels texels(float* sums) const {
            return {{part.z, part.w}, positions.data(), surfaces.data(), sums};
        }
    };
    std::vector<ViewLevel> mView;
    std::uint64_t mViewDrawn = 0;    ///< SplattingBuffer::drawn() of mView
    glm::ivec4 mViewPart{0};         ///< SplattingBuffer::bounds() then
    glm::ivec4 mLitPart;             ///< of level 0: elsewhere mExitance is 0
    std::vector<LightState> mLights; ///< more light views take turns, and keep nothing
    std::size_t mLastLight = 0;
    std::uint64_t mGatheredPairs = 0;
    std::vector<float> mRadii; ///< read back
};

} // namespace celadon
