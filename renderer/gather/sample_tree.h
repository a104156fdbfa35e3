#pragma once

#include "renderer/gather/changed_texels.h"

#include <array>
#include <cstdint>
#include <vector>

/// The samples of one light view as a quadtree on the CPU: what irradiance_mip.comp,
/// node_profile.comp, node_radii.comp, node_ball.comp and sample_selection.vert make on a GPU
/// (DESIGN 3.1, 3.2), with the same meaning. No GL here.
namespace celadon {

/// Level 0 of the irradiance buffer: RGBA, `size` rows of `stride` texels, as
/// irradiance_buffer.frag writes them.
struct LightTexels {
    int size = 0;
    int stride = 0;
    const float* positions = nullptr;
    const float* normals = nullptr;
    const float* fluxes = nullptr;
    const float* surfaces = nullptr;
    const float* covariances = nullptr;
    const float* extents = nullptr;
    const float* kepts = nullptr;
};

struct TreeSettings {
    bool hierarchical = true;
    int levels = 6;               ///< of the irradiance buffer; 1: level 0 only
    bool adaptive = true;         ///< paper: off selects level 0
    double cutEnergy = 1.0;       ///< that R_cut holds; 1: R_cut = r_s
    float alpha = 15.0f;          ///< eq. 11
    float discontinuityMm = 0.0f; ///< z_0, eq. 10
    bool orientation = true;      ///< |n . l| in eq. 11
    float texelScale = 0.0f;      ///< width of a texel at depth z of the light's view:
    float texelOffset = 0.0f;     ///<   z * texelScale + texelOffset, mm
    float sampleAngle = 1.8f;     ///< theta_s
    float fade = 0.6f;            ///< b
    float fineSpread = 0.06f;     ///< beta
};

/// A node's place in the tree and what a traversal asks first.
struct TreeNode {
    float position[3];
    float ball;          ///< mm; 0: stands for all below it; at least kNeverUsed: for none of it
    float extent;        ///< every leaf below lies within this of the position, mm
    float reach;         ///< no sample of this subtree counts beyond, mm from the sample
    std::uint32_t first; ///< child on the level below
    std::uint8_t children;
    bool selected; ///< paper: a sample; hierarchical: counts at some distance
    std::int16_t material;
    float R_P;
};

class SampleTree {
public:
    static constexpr float kNeverUsed = 1e30f;

    /// All of a node that a traversal looks at on its way: half a cache line.
    struct alignas(32) NodeBall {
        float x, y, z, ball;
        float extent;
        float range; ///< r_s of the sample's own profile
        std::uint32_t first, children;
    };
    static constexpr std::size_t kSiblings = 4; ///< at most

    struct Level {
        std::vector<TreeNode> nodes; ///< in the order of their Morton codes
        std::vector<gather::Sample> samples;
        std::vector<NodeBall> balls; ///< hierarchical; some more than there are nodes
    };

    /// Replaces what was there; memory is reused.
    /// @param before   null, or the tree of the same texels and settings whose workspace this has
    ///                 taken: what no change touches is taken from it
    /// @param changed  since then
    void build(const LightTexels& texels, const GatherMaterials& materials,
               const TreeSettings& settings, const SampleTree* before = nullptr,
               const ChangedTexels& changed = {});

    /// Takes over the memory that only building needs, from a tree that is only compared with from
    /// now on: more than half of it.
    void takeWorkspace(SampleTree& other) {
        mMeans.swap(other.mMeans);
        mRoots.swap(other.mRoots);
        mRadii.swap(other.mRadii);
    }

    /// A copy without what only building needs.
    [[nodiscard]] SampleTree withoutWorkspace() const;

    /// From the leaves to one root; levels beyond settings.levels only bound their subtrees. Empty
    /// where nothing is lit.
    [[nodiscard]] const std::vector<Level>& levels() const { return mLevels; }
    [[nodiscard]] const std::vector<std::uint16_t>& codes() const { return mCodes; }
    [[nodiscard]] const TreeSettings& settings() const { return mSettings; }
    /// Whether the nodes and codes of both have the same places.
    [[nodiscard]] bool hasShapeOf(const SampleTree& other) const {
        return mMorton == other.mMorton && mCodes.size() == other.mCodes.size() &&
               mSettings.levels == other.mSettings.levels;
    }

    struct Counts {
        std::uint64_t candidates = 0;         ///< lit nodes of all levels
        std::vector<std::uint64_t> selected;  ///< per level
        std::array<double, 3> litFlux{};      ///< 1e-6 W
        std::array<double, 3> selectedFlux{}; ///< hierarchical: of nodes without a ball
    };
    [[nodiscard]] Counts count() const;

private:
    /// Means over a node's footprint, weighted by flux.
    struct Mean {
        float flux[3];
        float weight; ///< sum of flux
        float position[3];
        float depth;
        float normal[3];
        float cosine;
        float covariance[6]; ///< xx, xy, xz, yy, yz, zz
        float R_P, R_cut, R_Pmin;
        float kept[3];
        std::int32_t material;
    };

    /// R_P (energy 0.95) of a node's longest and shortest channel, R_cut, and what that keeps.
    struct Radii {
        float longest = 0.0f, shortest = 1e30f, cut = 0.0f;
        float kept[3] = {1.0f, 1.0f, 1.0f};
    };
    static Radii radiiOf(const float* roots, const float* logP, int segments, float h,
                         double cutEnergy);

    static void setRadii(Mean& mean, const Radii& radii);

    void makeLeaves(const LightTexels& texels);
    void makeParents(std::size_t level);
    [[nodiscard]] std::size_t codesOf(std::size_t level, std::size_t i) const;
    void placeProfiles(std::size_t levels);
    void makeProfiles(const LightTexels& texels, std::size_t level, const SampleTree* before,
                      const ChangedTexels& changed);
    void measureDepths(const LightTexels& texels);
    void select(std::size_t level);
    void growBalls(std::size_t level);
    void dropReplaced(std::size_t level);
    void bound(std::size_t level);
    void arrange(std::size_t level);
    void finishSample(std::size_t level, std::size_t i);

    const GatherMaterials* mMaterials = nullptr;
    TreeSettings mSettings;
    std::vector<Level> mLevels;
    std::vector<std::vector<Mean>> mMeans;
    std::vector<std::vector<std::uint32_t>> mMorton;
    std::vector<std::vector<float>> mRoots; ///< sqrt(P) of a level's nodes on the common knots
    std::vector<std::vector<Radii>> mRadii; ///< above level 0
    std::vector<std::vector<std::uint8_t>> mIsNew; ///< whether a node's profile is not before's
    std::vector<std::vector<std::array<float, 2>>> mDepths; ///< dense: least and greatest, 2^k
    std::vector<std::uint16_t> mCodes; ///< of all profiles, and gather::kCodesBehind more
};

} // namespace celadon
