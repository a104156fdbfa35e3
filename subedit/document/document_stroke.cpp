#include "subedit/assert.h"
#include "subedit/document/open_stroke.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <utility>

// Strokes as they happen: every texel that a point changes is computed anew from what it was before
// the stroke and the weight that it has now, so that the result does not depend on how often.
namespace celadon::subedit {

Document::OpenStroke::OpenStroke(Document& document, StrokeCommand strokeCommand)
    : owner(document),
      command(std::move(strokeCommand)),
      dabs(document.surface(), command.brush, command.mirror),
      tiles(static_cast<std::size_t>(document.mSelection.tileCount())) {
    entry.mask = WeightMask(document.material().width, document.material().height);
    forget();
}

void Document::OpenStroke::forget() {
    for (auto& tile : tiles) {
        tile.reset();
    }
    owner.mSetAside.reset(layoutOf(owner.material()).values());
    prepare();
}

void Document::OpenStroke::prepare() {
    prepared = std::make_unique<PreparedOperator>(command.op, layoutOf(owner.material()),
                                                  owner.mLargestRadiusMm, owner.surface(), *this);
}

const float* Document::OpenStroke::profile(Surface::Texel texel) const {
    const auto width = static_cast<Surface::Texel>(owner.material().width);
    const int x = static_cast<int>(texel % width);
    const int y = static_cast<int>(texel / width);
    const std::size_t values = layoutOf(owner.material()).values();
    const Tile* tile = tiles[static_cast<std::size_t>(entry.mask.tileOf(x, y))].get();
    const std::size_t cell = WeightMask::cell(x, y);
    return tile != nullptr && tile->before[cell] != nullptr
               ? tile->before[cell]
               : owner.material().logProfile.data() + texel * values;
}

std::vector<Document::OpenStroke::Target>
Document::OpenStroke::save(std::span<const std::size_t> texels) {
    const auto width = static_cast<std::size_t>(owner.material().width);
    std::vector<Target> targets;
    targets.reserve(texels.size());
    struct Copy {
        const float* from;
        float* to;
    };
    std::vector<Copy> copies;
    copies.reserve(texels.size());
    for (const std::size_t texel : texels) {
        const int x = static_cast<int>(texel % width);
        const int y = static_cast<int>(texel / width);
        const int index = entry.mask.tileOf(x, y);
        owner.markTexel(index, x, y);
        std::unique_ptr<Tile>& tile = tiles[static_cast<std::size_t>(index)];
        if (tile == nullptr) {
            tile = std::make_unique<Tile>();
        }
        const std::size_t cell = WeightMask::cell(x, y);
        float* const data = owner.texelData(texel);
        float*& before = tile->before[cell];
        if (before == nullptr) {
            before = owner.mSetAside.take();
            copies.push_back({data, before});
        }
        targets.push_back({static_cast<Surface::Texel>(texel), entry.mask.at(x, y), before, data,
                           &tile->outcome[cell]});
    }
    const std::size_t values = layoutOf(owner.material()).values();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, copies.size(), 512),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              std::copy_n(copies[i].from, values, copies[i].to);
                          }
                      });
    return targets;
}

std::uint8_t& Document::OpenStroke::outcome(std::size_t texel) {
    const auto width = static_cast<std::size_t>(owner.material().width);
    const int x = static_cast<int>(texel % width);
    const int y = static_cast<int>(texel / width);
    return tiles[static_cast<std::size_t>(entry.mask.tileOf(x, y))]
        ->outcome[WeightMask::cell(x, y)];
}

void Document::beginStroke(StrokeCommand stroke) {
    CELADON_ASSERT(!isStrokeOpen());
    const std::vector<StrokePoint> path = std::exchange(stroke.path, {});
    mStroke = std::make_unique<OpenStroke>(*this, std::move(stroke));
    try {
        for (const StrokePoint& point : path) {
            addStrokePoint(point);
        }
    } catch (...) {
        cancelStroke();
        throw;
    }
}

void Document::addStrokePoint(const StrokePoint& point) {
    CELADON_ASSERT(isStrokeOpen());
    mStroke->dabs.add(point); // may refuse it
    mStroke->command.path.push_back(point);

    std::vector<std::size_t> texels;
    for (const Surface::Texel texel : mStroke->dabs.takeChanged()) {
        if (setStrokeWeight(mStroke->dabs, texel, mStroke->entry.mask)) {
            texels.push_back(texel);
            const auto gutter = mSurface->gutterOf(texel);
            texels.insert(texels.end(), gutter.begin(), gutter.end());
        }
    }
    float neededMm = evaluateStroke(texels);
    while (const auto grown = grownLayout(layoutOf(*mMaterial), neededMm, mLargestRadiusMm)) {
        restoreStroke();
        grow(*grown, mStroke->entry);
        mStroke->forget();
        texels.clear();
        mStroke->entry.mask.forEachNonZero(
            [&](std::size_t texel, auto) { texels.push_back(texel); });
        neededMm = evaluateStroke(texels);
    }
}

/// @return the r_s that the texels need
float Document::evaluateStroke(std::span<const std::size_t> texels) {
    const std::vector<OpenStroke::Target> targets = mStroke->save(texels);
    std::mutex mutex;
    float neededMm = 0.0f;
    tbb::enumerable_thread_specific<PreparedOperator::Worker> workers(
        [&] { return PreparedOperator::Worker(*mStroke->prepared); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, targets.size(), 128),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          PreparedOperator::Worker& worker = workers.local();
                          float needed = 0.0f;
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              const OpenStroke::Target& target = targets[i];
                              const TexelOutcome outcome =
                                  worker.evaluate(target.texel, target.before,
                                                  weightToFloat(target.weight), target.after);
                              *target.outcome = static_cast<std::uint8_t>(
                                  (outcome.energyClamped ? 1 : 0) | (outcome.rangeClamped ? 2 : 0));
                              needed = std::max(needed, outcome.neededRadiusMm);
                          }
                          const std::lock_guard lock(mutex);
                          neededMm = std::max(neededMm, needed);
                      });
    return neededMm;
}

void Document::restoreStroke() {
    const std::size_t values = layoutOf(*mMaterial).values();
    for (int t = 0; t < mStroke->entry.mask.tileCount(); ++t) {
        mStroke->entry.mask.forEachNonZeroOfTile(t, [&](std::size_t texel, auto) {
            std::copy_n(mStroke->profile(static_cast<Surface::Texel>(texel)), values,
                        texelData(texel));
            markTile(t);
        });
    }
}

void Document::cancelStroke() {
    CELADON_ASSERT(isStrokeOpen());
    restoreStroke();
    undoGrowths(mStroke->entry);
    mStroke.reset();
}

EditReport Document::endStroke() {
    CELADON_ASSERT(isStrokeOpen());
    if (!mStroke->entry.growth.empty()) {
        // Where r_s grew on the way, its steps may depend on when: the whole stroke at once is what
        // a replay will do.
        const EditCommand command = mStroke->command;
        cancelStroke();
        return execute(command);
    }
    auto entry = std::make_unique<Entry>(std::move(mStroke->entry));
    mStroke->entry.mask = entry->mask; // profile() goes on looking at it
    entry->mask.compact();
    const std::size_t values = layoutOf(*mMaterial).values();
    for (int t = 0; t < entry->mask.tileCount(); ++t) {
        if (entry->mask.tile(t) == nullptr) {
            continue;
        }
        TileBefore before{t, entry->weighted(t), {}};
        before.values.reserve(before.kept.count() * values);
        entry->mask.forEachNonZeroOfTile(t, [&](std::size_t texel, auto) {
            const float* data = mStroke->profile(static_cast<Surface::Texel>(texel));
            before.values.insert(before.values.end(), data, data + values);
            const std::uint8_t outcome = mStroke->outcome(texel);
            entry->report.add({(outcome & 1) != 0, (outcome & 2) != 0, 0.0f});
        });
        entry->before.push_back(std::move(before));
    }
    entry->command = std::move(mStroke->command);
    mStroke.reset();
    const EditReport report = entry->report;
    commit(std::move(entry));
    return report;
}

} // namespace celadon::subedit
