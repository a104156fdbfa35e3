#pragma once

#include "renderer/gather/tile_gather.h"
#include "renderer/scene/point_bounds.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <vector>

namespace celadon {

inline constexpr float kDropped = 0.999f; ///< Rbar from which a level is left out

/// A sample that may count in some tile of a block, with what decides about each of them.
struct Listed {
    gather::Candidate candidate;
    glm::vec3 position;
    float ball; ///< hierarchical
    glm::vec3 parentPosition;
    float parentBall; ///< 0: no parent
    bool isOwn;       ///< false: did not change itself, only its parent, which it stands in for
};

/// Walks the tree for a block of tiles and lists the samples that may count there.
class Traversal {
public:
    Traversal(const SampleTree& tree, const GatherMaterials& materials,
              const GatherSettings& settings, int splattingLevels)
        : mTree(tree),
          mSettings(settings),
          mRangeMm(materials.commonKnots().rangeMm),
          mLevels(splattingLevels) {}

    /// @param only  null: all samples that count. Else those that do not bring the same in the two
    ///              trees, of one shape, of which this walks one; hierarchical only
    void list(const PointBounds& bounds, int splattingLevel, const TreeChange* only,
              std::vector<Listed>& found) {
        mOnly = only;
        mFound = &found;
        mBounds = bounds;
        mLevel = splattingLevel;
        found.clear();
        if (!mTree.levels().empty() && !mTree.levels().back().nodes.empty()) {
            if (mSettings.hierarchical) {
                visitHierarchical(mTree.levels().size() - 1, 0, nullptr, glm::vec2(0.0f));
            } else {
                visitPaper(mTree.levels().size() - 1, 0);
            }
        }
    }

    /// Those of a block's list that count in one of its tiles.
    void choose(const std::vector<Listed>& listed, const PointBounds& tile,
                std::vector<gather::Candidate>& chosen) const {
        chosen.clear();
        for (const Listed& one : listed) {
            if (mSettings.hierarchical ? countsHierarchical(one, tile) : countsPaper(one, tile)) {
                chosen.push_back(one.candidate);
            }
        }
    }

private:
    [[nodiscard]] float depthOf(const float* p) const {
        const glm::mat4& m = mSettings.view;
        return -(m[0][2] * p[0] + m[1][2] * p[1] + m[2][2] * p[2] + m[3][2]);
    }
    [[nodiscard]] float pixelWidth(float depth, int k) const {
        return (std::max(depth, 1e-3f) * mSettings.pixelScale + mSettings.pixelOffset) *
               static_cast<float>(1 << k);
    }
    [[nodiscard]] float ringRadius(int k, float depth) const {
        return k == 0 ? 0.0f : pixelWidth(depth, k) / mSettings.pixelAngle;
    }
    /// 0: this ring reaches r_s. A level whose ring would begin beyond is left out.
    [[nodiscard]] float nextRing(float depth) const {
        const float next = mLevel + 1 < mLevels ? ringRadius(mLevel + 1, depth) : mRangeMm;
        return next < mRangeMm ? next : 0.0f;
    }

    [[nodiscard]] bool countsHierarchical(const Listed& one, const PointBounds& tile) const {
        const glm::vec2 squared = tile.squaredDistances(one.position);
        const auto square = [](float x) { return x * x; };
        if (squared.x >= square(mRangeMm) || squared.y < square(one.ball) ||
            squared.y <= square(gather::kRingLow * one.candidate.low) ||
            (one.candidate.high > 0.0f &&
             squared.x >= square(gather::kRingHigh * one.candidate.high))) {
            return false;
        }
        if (one.parentBall <= 0.0f) {
            return true;
        }
        const glm::vec2 fromParent = tile.squaredDistances(one.parentPosition);
        return fromParent.x < square((1.0f + mSettings.fade) * one.parentBall) &&
               (one.isOwn || fromParent.y >= square(one.parentBall));
    }

    static bool countsPaper(const Listed& one, const PointBounds& tile) {
        const glm::vec2 squared = tile.squaredDistances(one.position);
        return squared.x < one.candidate.high * one.candidate.high &&
               squared.y >= one.candidate.low * one.candidate.low;
    }

    /// @param parent  null for the root
    /// @param parentDistances  least and greatest distance of the tile from it
    void visitHierarchical(std::size_t level, std::uint32_t index, const TreeNode* parent,
                           glm::vec2 parentDistances) {
        const SampleTree::Level& nodes = mTree.levels()[level];
        const TreeNode& node = nodes.nodes[index];
        const glm::vec2 distances = mBounds.distances(glm::make_vec3(node.position));
        const float nearest = distances.x;
        const float farthest = distances.y;
        if (nearest - node.extent >= mRangeMm) {
            return;
        }
        const float depth = depthOf(node.position);
        // Rings of the whole subtree lie between those of its nearest and its farthest depth.
        if (gather::kRingLow * ringRadius(mLevel, depth - node.extent) > farthest + node.extent) {
            return;
        }
        const float outermost = nextRing(depth + node.extent);
        if (outermost > 0.0f && gather::kRingHigh * outermost < nearest - node.extent) {
            return;
        }
        // Of changes: what did not change itself counts where it stands in for a parent that did.
        const bool isChanged = mOnly == nullptr || mOnly->at(level, index);
        const float fadeEnd = (1.0f + mSettings.fade) * node.ball;
        if (node.ball < SampleTree::kNeverUsed && nearest < mRangeMm && farthest >= node.ball &&
            (parent == nullptr || parent->ball >= SampleTree::kNeverUsed ||
             parentDistances.x < (1.0f + mSettings.fade) * parent->ball)) {
            const gather::Sample* usedParent =
                parent != nullptr && parent->ball < SampleTree::kNeverUsed ? mParentSample
                                                                           : nullptr;
            const float low = ringRadius(mLevel, depth);
            const float high = nextRing(depth);
            if (low < mRangeMm && farthest > gather::kRingLow * low &&
                (high == 0.0f || nearest < gather::kRingHigh * high) &&
                (isChanged || (usedParent != nullptr && parentDistances.y >= parent->ball))) {
                mFound->push_back(
                    {{&nodes.samples[index], usedParent, low, high},
                     glm::make_vec3(node.position),
                     node.ball,
                     usedParent != nullptr ? glm::make_vec3(parent->position) : glm::vec3(0.0f),
                     usedParent != nullptr ? parent->ball : 0.0f,
                     isChanged});
            }
        }
        if (node.ball > 0.0f && (node.ball >= SampleTree::kNeverUsed || nearest < fadeEnd) &&
            isChanged) {
            const gather::Sample* before = mParentSample;
            mParentSample = &nodes.samples[index];
            for (std::uint32_t j = node.first; j < node.first + node.children; ++j) {
                visitHierarchical(level - 1, j, &node, distances);
            }
            mParentSample = before;
        }
    }

    /// R_min^k of a sample; see raster_splat.vert.
    [[nodiscard]] float ringStart(const TreeNode& node, int k, float depth) const {
        if (k == 0) {
            return 0.0f;
        }
        const float start = mSettings.minimalRadius(node.R_P / pixelWidth(depth, k), node.material);
        return start < kDropped ? node.R_P * start : node.reach;
    }

    void visitPaper(std::size_t level, std::uint32_t index) {
        const SampleTree::Level& nodes = mTree.levels()[level];
        const TreeNode& node = nodes.nodes[index];
        const glm::vec2 distances = mBounds.distances(glm::make_vec3(node.position));
        if (distances.x - node.extent >= node.reach) {
            return;
        }
        if (!node.selected) {
            for (std::uint32_t j = node.first; level > 0 && j < node.first + node.children; ++j) {
                visitPaper(level - 1, j);
            }
            return;
        }
        const float cut = node.reach;
        float low = 0.0f;
        float high = cut;
        if (mSettings.multiresolution) {
            const float depth = std::max(depthOf(node.position), 1e-3f);
            for (int j = 1; j <= mLevel; ++j) {
                low = std::max(low, ringStart(node, j, depth));
            }
            low = std::min(low, cut);
            if (mLevel + 1 < mLevels) {
                high = std::min(std::max(low, ringStart(node, mLevel + 1, depth)), cut);
            }
        }
        if (low < high && distances.x < high && distances.y >= low) {
            mFound->push_back({{&nodes.samples[index], nullptr, low, high},
                               glm::make_vec3(node.position),
                               0.0f,
                               glm::vec3(0.0f),
                               0.0f,
                               true});
        }
    }

    const SampleTree& mTree;
    const GatherSettings& mSettings;
    float mRangeMm;
    int mLevels;
    int mLevel = 0;
    PointBounds mBounds;
    const gather::Sample* mParentSample = nullptr;
    const TreeChange* mOnly = nullptr; ///< null: all samples
    std::vector<Listed>* mFound = nullptr;
};

} // namespace celadon
