#include "renderer/gather/tile_gather.h"

#include "renderer/gather/tile.h"
#include "renderer/gather/traversal.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace celadon {

namespace {

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
constexpr std::size_t kMostTiles = std::size_t{blockSide(0)} * blockSide(0);

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
        mBlock = {};
        std::array<PointBounds, kMostTiles> bounds;
        const int side = blockSide(mJob.level);
        const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        for (std::size_t i = 0; i < count; ++i) {
            if (mLoader.locate(mJob.view, cornerOf(block, i))) {
                bounds[i] = mLoader.bounds;
                mBlock.add(bounds[i].low);
                mBlock.add(bounds[i].high);
            }
        }
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
        listed().choose(mLoader.bounds, mFound);
        mLoader.loadProfiles(mJob.view, corner);
        const std::uint64_t added = addPairs(mFound, mJob.tree);
        mLoader.store(mJob.view, corner, added);
        mPairs += added;
    }

    /// Takes away what changed samples brought and adds what they bring now.
    /// @return false where gathering all again costs no more
    bool gatherChange(glm::ivec2 corner) {
        listChange();
        mListedCome.choose(mLoader.bounds, mFound);
        mListedGone.choose(mLoader.bounds, mGone);
        if (mFound.empty() && mGone.empty()) {
            return true;
        }
        if (const std::size_t both = mFound.size() + mGone.size(); both > kFew) {
            listed().choose(mLoader.bounds, mAll);
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

    CandidateList& listed() {
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

    std::uint64_t addPairs(const std::vector<celadon::gather::Candidate>& candidates,
                           const SampleTree& tree) {
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
    CandidateList mListed, mListedCome, mListedGone;
    std::vector<celadon::gather::Candidate> mFound, mGone, mAll; ///< of the tile
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
