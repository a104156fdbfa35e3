#include "renderer/gather/tile_gather.h"

#include "renderer/gather/tile.h"

#include <glm/gtc/type_ptr.hpp>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace celadon {

namespace {

using gather::Candidate;

constexpr float kDropped = 0.999f; ///< Rbar from which a level is left out

/// Walks the tree for one tile and lists the samples that count there.
class Traversal {
public:
    Traversal(const SampleTree& tree, const GatherMaterials& materials,
              const GatherSettings& settings, int splattingLevels)
        : mTree(tree),
          mSettings(settings),
          mRangeMm(materials.commonKnots().rangeMm),
          mLevels(splattingLevels) {}

    const std::vector<Candidate>& find(const PointBounds& bounds, int splattingLevel) {
        mOnly = nullptr;
        walk(bounds, splattingLevel);
        return mFound;
    }

    /// Whether any sample that is not the same in two trees of one shape, of which this walks one,
    /// counts in the tile.
    bool reaches(const TreeChange& change, const PointBounds& bounds, int splattingLevel) {
        mOnly = &change;
        walk(bounds, splattingLevel);
        return !mFound.empty();
    }

private:
    void walk(const PointBounds& bounds, int splattingLevel) {
        mBounds = bounds;
        mLevel = splattingLevel;
        mFound.clear();
        if (!mTree.levels().empty() && !mTree.levels().back().nodes.empty()) {
            if (mSettings.hierarchical) {
                visitHierarchical(mTree.levels().size() - 1, 0, nullptr, glm::vec2(0.0f));
            } else {
                visitPaper(mTree.levels().size() - 1, 0);
            }
        }
    }

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
        if (0.8f * ringRadius(mLevel, depth - node.extent) > farthest + node.extent) {
            return;
        }
        const float outermost = nextRing(depth + node.extent);
        if (outermost > 0.0f && 1.2f * outermost < nearest - node.extent) {
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
            if (low < mRangeMm && farthest > 0.8f * low &&
                (high == 0.0f || nearest < 1.2f * high) &&
                (isChanged || (usedParent != nullptr && parentDistances.y >= parent->ball))) {
                mFound.push_back({&nodes.samples[index], usedParent, low, high});
            }
        }
        if (node.ball > 0.0f && (node.ball >= SampleTree::kNeverUsed || nearest < fadeEnd) &&
            isChanged && (mOnly == nullptr || mFound.empty())) {
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
            mFound.push_back({&nodes.samples[index], nullptr, low, high});
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
    std::vector<Candidate> mFound;
};

struct Worker {
    Worker(const SampleTree& tree, const GatherMaterials& materials, const GatherSettings& settings,
           int levels, const GatherChange* theChange)
        : loader(materials), traversal(tree, materials, settings, levels), change(theChange) {
        if (change != nullptr) {
            before.emplace(change->tree.before(), materials, settings, levels);
        }
    }

    /// Whether the located tile's sums are not what they were.
    bool isChanged(const ViewTexels& view, glm::ivec2 corner, int level) {
        return change == nullptr || loader.dependsOn(view, corner, change->texels) ||
               before->reaches(change->tree, loader.bounds, level) ||
               traversal.reaches(change->tree, loader.bounds, level);
    }

    TileLoader loader;
    Traversal traversal;
    const GatherChange* change;
    std::optional<Traversal> before; ///< of the tree that the sums came from
    std::uint64_t pairs = 0;
};

} // namespace

std::uint64_t gatherLevel(const SampleTree& tree, const GatherMaterials& materials,
                          const ViewTexels& view, int level, int levelCount,
                          const GatherSettings& settings, const GatherChange* change) {
    const glm::ivec2 tiles = (view.size + gather::kTileSide - 1) / gather::kTileSide;
    const gather::PairFunction addPairs = gather::choosePairFunction();
    const gather::Solve solve{materials.scale(), tree.codes().data(), materials.profiles(),
                              settings.hierarchical, settings.fade};
    tbb::enumerable_thread_specific<Worker> workers(
        [&] { return Worker(tree, materials, settings, levelCount, change); });
    tbb::parallel_for(tbb::blocked_range<int>(0, tiles.x * tiles.y, 4), [&](const auto& range) {
        Worker& worker = workers.local();
        for (int i = range.begin(); i < range.end(); ++i) {
            const glm::ivec2 corner = glm::ivec2(i % tiles.x, i / tiles.x) * gather::kTileSide;
            if (!worker.loader.locate(view, corner) || !worker.isChanged(view, corner, level)) {
                continue;
            }
            worker.loader.loadProfiles(view, corner);
            const std::vector<Candidate>& found =
                worker.traversal.find(worker.loader.bounds, level);
            const std::uint64_t pairs =
                addPairs(worker.loader.tile, found.data(), static_cast<int>(found.size()), solve);
            worker.loader.store(view, corner, pairs);
            worker.pairs += pairs;
        }
    });
    std::uint64_t pairs = 0;
    for (const Worker& worker : workers) {
        pairs += worker.pairs;
    }
    return pairs;
}

} // namespace celadon
