#pragma once

#include "renderer/gather/candidate_list.h"
#include "renderer/gather/four.h"
#include "renderer/gather/tile_gather.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace celadon {

inline constexpr float kDropped = 0.999f; ///< Rbar from which a level is left out

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
              CandidateList& found) {
        mOnly = only;
        mFound = &found;
        mBounds = bounds;
        mLevel = splattingLevel;
        found.clear();
        if (!mTree.levels().empty() && !mTree.levels().back().nodes.empty()) {
            const std::size_t root = mTree.levels().size() - 1;
            if (mSettings.hierarchical) {
                visitSiblings(root, 0, 1, {});
            } else {
                visitPaper(root, 0);
            }
        }
    }

private:
    static constexpr float kEverywhere = CandidateList::kEverywhere;

    /// What siblings need of their parent.
    struct Parent {
        const SampleTree::NodeBall* node = nullptr; ///< null: none that is used
        bool isInside = false;                      ///< of the block something lies beyond the ball
    };

    [[nodiscard]] float depthOf(const float* p) const {
        const glm::mat4& m = mSettings.view;
        return -(m[0][2] * p[0] + m[1][2] * p[1] + m[2][2] * p[2] + m[3][2]);
    }
    [[nodiscard]] float pixelWidth(float depth, int k) const {
        return (std::max(depth, 1e-3f) * mSettings.pixelScale + mSettings.pixelOffset) *
               static_cast<float>(1 << k);
    }
    [[nodiscard]] Four ringRadii(int k, Four depth) const {
        if (k == 0) {
            return four(0.0f);
        }
        const Four width =
            larger(depth, four(1e-3f)) * mSettings.pixelScale + mSettings.pixelOffset;
        return width * (static_cast<float>(1 << k) / mSettings.pixelAngle);
    }
    /// Where the next ring begins; kEverywhere: this one reaches r_s. A level whose ring would
    /// begin beyond is left out.
    [[nodiscard]] Four nextRings(Four depth) const {
        if (mLevel + 1 >= mLevels) {
            return four(kEverywhere);
        }
        const Four next = ringRadii(mLevel + 1, depth);
        return next < mRangeMm ? next : four(kEverywhere);
    }

    /// What counts of up to four siblings, and of what is below them.
    void visitSiblings(std::size_t level, std::uint32_t first, int count, const Parent& parent) {
        const SampleTree::NodeBall* const nodes = mTree.levels()[level].balls.data() + first;
        const Four a = loadFour(&nodes[0].x), b = loadFour(&nodes[1].x);
        const Four c = loadFour(&nodes[2].x), d = loadFour(&nodes[3].x);
        const Four abXY = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        const Four cdXY = __builtin_shufflevector(c, d, 0, 4, 1, 5);
        const Four abZBall = __builtin_shufflevector(a, b, 2, 6, 3, 7);
        const Four cdZBall = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        const Four x = __builtin_shufflevector(abXY, cdXY, 0, 1, 4, 5);
        const Four y = __builtin_shufflevector(abXY, cdXY, 2, 3, 6, 7);
        const Four z = __builtin_shufflevector(abZBall, cdZBall, 0, 1, 4, 5);
        const Four ball = __builtin_shufflevector(abZBall, cdZBall, 2, 3, 6, 7);
        const Four extent{nodes[0].extent, nodes[1].extent, nodes[2].extent, nodes[3].extent};
        const Four range{nodes[0].range, nodes[1].range, nodes[2].range, nodes[3].range};
        const glm::vec3& low = mBounds.low;
        const glm::vec3& high = mBounds.high;
        // Squares of the least and greatest distance of the block.
        const Four none = four(0.0f);
        const Four nearest = square(larger(larger(low.x - x, x - high.x), none)) +
                             square(larger(larger(low.y - y, y - high.y), none)) +
                             square(larger(larger(low.z - z, z - high.z), none));
        const Four farthest = square(larger(x - low.x, high.x - x)) +
                              square(larger(y - low.y, high.y - y)) +
                              square(larger(z - low.z, high.z - z));
        const glm::mat4& m = mSettings.view;
        const Four depth = -(m[0][2] * x + m[1][2] * y + m[2][2] * z + m[3][2]);
        // Rings of a whole subtree lie between those of its nearest and its farthest depth.
        const Four innermost =
            larger(gather::kRingLow * ringRadii(mLevel, depth - extent) - extent, none);
        const Four outermost = gather::kRingHigh * nextRings(depth + extent) + extent;
        const FourInts isReached = (nearest < square(mRangeMm + extent)) &
                                   (square(innermost) <= farthest) & (nearest <= square(outermost));
        const Four start = ringRadii(mLevel, depth);
        const Four end = nextRings(depth);
        const FourInts isUsed = ball < SampleTree::kNeverUsed;
        const Four usedBall = isUsed ? ball : none;
        FourInts counts = isReached & isUsed & (nearest < range * range) &
                          (farthest >= square(usedBall)) & (start < mRangeMm) &
                          (farthest > square(gather::kRingLow * start)) &
                          (nearest < square(gather::kRingHigh * end));
        const Four fadeEnd = (1.0f + mSettings.fade) * usedBall;
        const FourInts isFading = nearest < square(fadeEnd);
        const FourInts descends = isReached & (ball > 0.0f) & (~isUsed | isFading);
        std::array<std::int32_t, 4> countsOf, descendsTo, insides;
        std::memcpy(countsOf.data(), &counts, sizeof(counts));
        std::memcpy(descendsTo.data(), &descends, sizeof(descends));
        const FourInts isInside = farthest >= square(usedBall);
        std::memcpy(insides.data(), &isInside, sizeof(isInside));
        for (int i = 0; i < count; ++i) {
            if (descendsTo[static_cast<std::size_t>(i)] != 0) {
                const auto* const below = mTree.levels()[level - 1].balls.data() + nodes[i].first;
                __builtin_prefetch(below);
                __builtin_prefetch(below + 2);
            }
        }
        for (int i = 0; i < count; ++i) {
            const auto lane = static_cast<std::size_t>(i);
            if ((countsOf[lane] | descendsTo[lane]) == 0) {
                continue;
            }
            const std::uint32_t index = first + static_cast<std::uint32_t>(i);
            // Of changes: what did not change itself counts where it stands in for a parent that
            // did.
            const bool isChanged = mOnly == nullptr || mOnly->at(level, index);
            if (countsOf[lane] != 0 && (isChanged || (parent.node != nullptr && parent.isInside))) {
                add(mTree.levels()[level].samples[index], nodes[i], parent, start[i], end[i],
                    isChanged);
            }
            if (descendsTo[lane] != 0 && isChanged) {
                const SampleTree::NodeBall& node = nodes[i];
                const bool stands = node.ball < SampleTree::kNeverUsed;
                visitSiblings(level - 1, node.first, static_cast<int>(node.children),
                              stands ? Parent{&node, insides[lane] != 0} : Parent{});
            }
        }
    }

    void add(const gather::Sample& sample, const SampleTree::NodeBall& node, const Parent& parent,
             float start, float end, bool isOwn) {
        const bool isLast = end >= kEverywhere;
        gather::Candidate candidate{};
        candidate.sample = &sample;
        setPosition(candidate.position, node);
        candidate.least = std::max(node.ball, gather::kRingLow * start);
        candidate.most = isLast ? node.range : std::min(node.range, gather::kRingHigh * end);
        candidate.low = start;
        candidate.high = isLast ? 0.0f : end;
        if (parent.node != nullptr) {
            setPosition(candidate.parent, *parent.node);
            candidate.parentReach = (1.0f + mSettings.fade) * parent.node->ball;
        }
        mFound->add(candidate, isOwn || parent.node == nullptr ? 0.0f : parent.node->ball);
    }

    static void setPosition(float* position, const SampleTree::NodeBall& node) {
        position[0] = node.x;
        position[1] = node.y;
        position[2] = node.z;
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
            const gather::Sample& sample = nodes.samples[index];
            gather::Candidate candidate{};
            candidate.sample = &sample;
            std::copy_n(node.position, 3, candidate.position);
            candidate.least = candidate.low = low;
            candidate.most = candidate.high = std::min(high, sample.knots.rangeMm);
            mFound->add(candidate, 0.0f);
        }
    }

    const SampleTree& mTree;
    const GatherSettings& mSettings;
    float mRangeMm;
    int mLevels;
    int mLevel = 0;
    PointBounds mBounds;
    const TreeChange* mOnly = nullptr; ///< null: all samples
    CandidateList* mFound = nullptr;
};

} // namespace celadon
