#include "renderer/gather/tile_gather.h"

#include "renderer/gather/tile.h"

#include <glm/gtc/type_ptr.hpp>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace celadon {

namespace {

using gather::Candidate;

constexpr float kDropped = 0.999f; ///< Rbar from which a level is left out
/// Rings fade between these, in units of their radius.
constexpr float kRingLow = 0.8f;
constexpr float kRingHigh = 1.2f;

/// A sample that may count in some tile of a block, with what decides about each of them.
struct Listed {
    Candidate candidate;
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
                std::vector<Candidate>& chosen) const {
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
            squared.y <= square(kRingLow * one.candidate.low) ||
            (one.candidate.high > 0.0f && squared.x >= square(kRingHigh * one.candidate.high))) {
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
        if (kRingLow * ringRadius(mLevel, depth - node.extent) > farthest + node.extent) {
            return;
        }
        const float outermost = nextRing(depth + node.extent);
        if (outermost > 0.0f && kRingHigh * outermost < nearest - node.extent) {
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
            if (low < mRangeMm && farthest > kRingLow * low &&
                (high == 0.0f || nearest < kRingHigh * high) &&
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

/// What gathering needs besides the tile.
struct Job {
    const SampleTree& tree;
    const GatherMaterials& materials;
    const ViewTexels& view;
    int level, levelCount;
    const GatherSettings& settings;
    const GatherChange* change; ///< null: everything is gathered
    gather::PairFunction addPairs;

    [[nodiscard]] gather::Solve solve(const SampleTree& given) const {
        return {materials.scale(), given.codes().data(), materials.profiles(),
                settings.hierarchical, settings.fade};
    }
};

/// Tiles on a side of a block. Coarser pixels lie farther apart: their neighbors share less.
constexpr int blockSide(int level) {
    return std::max(4 >> level, 1);
}
constexpr std::size_t kMostTiles = 16;

class Worker {
public:
    explicit Worker(const Job& job)
        : mJob(job),
          mLoader(job.materials),
          mTraversal(job.tree, job.materials, job.settings, job.levelCount) {
        if (job.change != nullptr) {
            mBefore.emplace(job.change->tree.before(), job.materials, job.settings, job.levelCount);
        }
    }

    /// Brings a block of tiles up to date. Neighbors count much the same samples: the tree is
    /// walked once for all of them.
    void gather(glm::ivec2 block) {
        PointBounds all;
        std::array<PointBounds, kMostTiles> bounds;
        const int side = blockSide(mJob.level);
        const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        for (std::size_t i = 0; i < count; ++i) {
            if (mLoader.locate(mJob.view, cornerOf(block, i))) {
                bounds[i] = mLoader.bounds;
                all.add(bounds[i].low);
                all.add(bounds[i].high);
            }
        }
        mBlock = all;
        mIsListed = mIsChangeListed = false;
        for (std::size_t i = 0; i < count; ++i) {
            if (bounds[i].low.x <= bounds[i].high.x) {
                gatherTile(cornerOf(block, i));
            }
        }
    }

    [[nodiscard]] std::uint64_t pairs() const { return mPairs; }

private:
    static constexpr std::size_t kFew = 64; ///< candidates: fewer than most tiles have

    [[nodiscard]] glm::ivec2 cornerOf(glm::ivec2 block, std::size_t tile) const {
        const auto side = static_cast<std::size_t>(blockSide(mJob.level));
        return block + glm::ivec2(tile % side, tile / side) * gather::kTileSide;
    }

    void gatherTile(glm::ivec2 corner) {
        static_cast<void>(mLoader.locate(mJob.view, corner));
        if (mJob.change != nullptr && !mLoader.dependsOn(mJob.view, corner, mJob.change->texels) &&
            gatherChange(corner)) {
            return;
        }
        mTraversal.choose(listed(), mLoader.bounds, mFound);
        mLoader.loadProfiles(mJob.view, corner);
        const std::uint64_t added = addPairs(mFound, mJob.tree);
        mLoader.store(mJob.view, corner, added);
        mPairs += added;
    }

    /// Takes away what changed samples brought and adds what they bring now.
    /// @return false where gathering all again costs no more
    bool gatherChange(glm::ivec2 corner) {
        listChange();
        mTraversal.choose(mListedCome, mLoader.bounds, mFound);
        mBefore->choose(mListedGone, mLoader.bounds, mGone);
        if (mFound.empty() && mGone.empty()) {
            return true;
        }
        if (const std::size_t both = mFound.size() + mGone.size(); both > kFew) {
            mTraversal.choose(listed(), mLoader.bounds, mAll);
            if (both >= mAll.size()) {
                return false;
            }
        }
        mLoader.loadProfiles(mJob.view, corner);
        mPairs += addPairs(mGone, mJob.change->tree.before());
        for (auto& sum : mLoader.tile.sums) {
            for (float& value : sum) {
                value = -value;
            }
        }
        mPairs += addPairs(mFound, mJob.tree);
        mLoader.add(mJob.view, corner);
        return true;
    }

    const std::vector<Listed>& listed() {
        if (!std::exchange(mIsListed, true)) {
            mTraversal.list(mBlock, mJob.level, nullptr, mListed);
        }
        return mListed;
    }

    void listChange() {
        if (!std::exchange(mIsChangeListed, true)) {
            const TreeChange& change = mJob.change->tree;
            mTraversal.list(mBlock, mJob.level, &change, mListedCome);
            mBefore->list(mBlock, mJob.level, &change, mListedGone);
        }
    }

    std::uint64_t addPairs(const std::vector<Candidate>& candidates, const SampleTree& tree) {
        return mJob.addPairs(mLoader.tile, candidates.data(), static_cast<int>(candidates.size()),
                             mJob.solve(tree));
    }

    const Job& mJob;
    TileLoader mLoader;
    Traversal mTraversal;
    std::optional<Traversal> mBefore; ///< of the tree that the sums came from
    PointBounds mBlock;
    bool mIsListed = false;       ///< mListed is that of the block
    bool mIsChangeListed = false; ///< mListedCome and mListedGone are
    std::vector<Listed> mListed, mListedCome, mListedGone;
    std::vector<Candidate> mFound, mGone, mAll; ///< of the tile
    std::uint64_t mPairs = 0;
};

} // namespace

std::uint64_t gatherLevel(const SampleTree& tree, const GatherMaterials& materials,
                          const ViewTexels& view, int level, int levelCount,
                          const GatherSettings& settings, const GatherChange* change) {
    const int pixels = blockSide(level) * gather::kTileSide;
    const glm::ivec2 blocks = (view.size + pixels - 1) / pixels;
    const Job job{tree,       materials, view,   level,
                  levelCount, settings,  change, gather::choosePairFunction()};
    tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(job); });
    tbb::parallel_for(tbb::blocked_range<int>(0, blocks.x * blocks.y), [&](const auto& range) {
        Worker& worker = workers.local();
        for (int i = range.begin(); i < range.end(); ++i) {
            worker.gather(glm::ivec2(i % blocks.x, i / blocks.x) * pixels);
        }
    });
    std::uint64_t pairs = 0;
    for (const Worker& worker : workers) {
        pairs += worker.pairs();
    }
    return pairs;
}

} // namespace celadon
