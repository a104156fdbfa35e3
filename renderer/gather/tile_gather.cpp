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
    const PixelTiles& tiles;
    int level, levelCount;
    const GatherSettings& settings;
    const GatherChange* change; ///< null: everything is gathered
    gather::PairFunction addPairs;

    [[nodiscard]] gather::Solve solve(const SampleTree& given) const {
        return {materials.scale(), given.codes().data(), materials.profiles(),
                settings.hierarchical, settings.fade};
    }
};

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
    void gather(std::size_t block) {
        const std::size_t first = mJob.tiles.firstTile(block);
        const std::size_t end = mJob.tiles.endTile(block);
        mBlock = {};
        for (std::size_t i = first; i < end; ++i) {
            mBlock.add(mJob.tiles.bounds(i).low);
            mBlock.add(mJob.tiles.bounds(i).high);
        }
        mIsListed = mIsChangeListed = false;
        for (std::size_t i = first; i < end; ++i) {
            gatherTile(i);
        }
    }

    [[nodiscard]] std::uint64_t pairs() const { return mPairs; }

private:
    static constexpr std::size_t kFew = 64; ///< candidates: fewer than most tiles have

    void gatherTile(std::size_t index) {
        mLoader.locate(mJob.view, mJob.tiles.tile(index));
        mTile = mJob.tiles.bounds(index);
        if (mJob.change != nullptr && !mLoader.dependsOn(mJob.change->texels) && gatherChange()) {
            return;
        }
        listed().choose(mTile, mFound);
        mLoader.loadProfiles();
        const std::uint64_t added = addPairs(mFound, mJob.tree);
        mLoader.store(added);
        mPairs += added;
    }

    /// Takes away what changed samples brought and adds what they bring now.
    /// @return false where gathering all again costs no more
    bool gatherChange() {
        listChange();
        mListedCome.choose(mTile, mFound);
        mListedGone.choose(mTile, mGone);
        if (mFound.empty() && mGone.empty()) {
            return true;
        }
        if (const std::size_t both = mFound.size() + mGone.size(); both > kFew) {
            listed().choose(mTile, mAll);
            if (both >= mAll.size()) {
                return false;
            }
        }
        mLoader.loadProfiles();
        mPairs += addPairs(mGone, mJob.change->tree.before());
        for (auto& sum : mLoader.tile.sums) {
            for (float& value : sum) {
                value = -value;
            }
        }
        mPairs += addPairs(mFound, mJob.tree);
        mLoader.add();
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
    PointBounds mBlock, mTile;
    bool mIsListed = false;       ///< mListed is that of the block
    bool mIsChangeListed = false; ///< mListedCome and mListedGone are
    CandidateList mListed, mListedCome, mListedGone;
    std::vector<celadon::gather::Candidate> mFound, mGone, mAll; ///< of the tile
    std::uint64_t mPairs = 0;
};

} // namespace

std::uint64_t gatherLevel(const SampleTree& tree, const GatherMaterials& materials,
                          const ViewTexels& view, const PixelTiles& tiles, int level,
                          int levelCount, const GatherSettings& settings,
                          const GatherChange* change) {
    const Job job{tree,     materials, view,
                  tiles,    level,     levelCount,
                  settings, change,    gather::choosePairFunction()};
    tbb::enumerable_thread_specific<Worker> workers([&] { return Worker(job); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.blocks()), [&](const auto& range) {
        Worker& worker = workers.local();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            worker.gather(i);
        }
    });
    std::uint64_t pairs = 0;
    for (const Worker& worker : workers) {
        pairs += worker.pairs();
    }
    return pairs;
}

} // namespace celadon
