#include "subedit/assert.h"
#include "subedit/document/history_entry.h"
#include "subedit/document/open_stroke.h"
#include "subedit/stop_point.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

// Undo. A command keeps the profiles that it changed, until all of them together are too many. Then
// the oldest commands keep only what nothing else can give back: a texel's profile before the first
// command that changed it, or before one that follows an operator which looked at other texels. The
// rest is computed again when it is needed, by the same steps with the same bits. And when even
// that is too much, the oldest commands are forgotten: they can no longer be undone.
namespace celadon::subedit {

Document::~Document() = default;

TileBefore* Document::Entry::find(int tile) {
    const auto found = std::lower_bound(before.begin(), before.end(), tile,
                                        [](const TileBefore& b, int t) { return b.tile < t; });
    return found != before.end() && found->tile == tile ? &*found : nullptr;
}

TileBits Document::Entry::weighted(int tile) const {
    TileBits bits;
    if (const WeightMask::Tile* weights = mask.tile(tile)) {
        const TexelRect rect = mask.tileRect(tile);
        for (int y = rect.y; y < rect.bottom(); ++y) {
            for (int x = rect.x; x < rect.right(); ++x) {
                const std::size_t cell = WeightMask::cell(x, y);
                bits[cell] = (*weights)[cell] != 0;
            }
        }
    }
    return bits;
}

namespace {

/// What a command holds of paths and pictures.
std::size_t payloadBytes(const EditCommand& command) {
    if (const auto* stroke = std::get_if<StrokeCommand>(&command)) {
        return stroke->path.size() * sizeof(StrokePoint);
    }
    if (const auto* stamp = std::get_if<StampCommand>(&command)) {
        return stamp->stamp.weights.size();
    }
    const auto pathsOf = [](const std::vector<Scribble>& scribbles) {
        std::size_t points = 0;
        for (const Scribble& scribble : scribbles) {
            points += scribble.path.size();
        }
        return points * sizeof(StrokePoint);
    };
    if (const auto* propagate = std::get_if<PropagateCommand>(&command)) {
        return pathsOf(propagate->propagation.scribbles);
    }
    if (const auto* select = std::get_if<SelectCommand>(&command)) {
        if (const auto* stroke = std::get_if<SelectStroke>(&select->step)) {
            return stroke->path.size() * sizeof(StrokePoint);
        }
    }
    return 0;
}

} // namespace

std::size_t Document::Entry::profileBytes() const {
    std::size_t bytes = 0;
    for (const TileBefore& tile : before) {
        bytes += sizeof(tile) + tile.values.size() * sizeof(float);
    }
    return bytes;
}

std::size_t Document::Entry::otherBytes() const {
    std::size_t bytes = sizeof(*this) + mask.bytesBeyond(selectionBefore) + payloadBytes(command);
    for (const Growth& g : growth) {
        bytes += g.before.size() * sizeof(float) + g.changedTexels.size() * 4;
    }
    return bytes;
}

/// Changes what an entry of the history keeps.
template<typename Change>
void Document::accountFor(Entry& entry, Change&& change) {
    mProfileBytes -= entry.profileBytes();
    mOtherBytes -= entry.accounted;
    const auto countAgain = [&] {
        entry.accounted = entry.otherBytes();
        mProfileBytes += entry.profileBytes();
        mOtherBytes += entry.accounted;
    };
    try {
        change();
    } catch (...) { // what is there is counted, whatever it is
        countAgain();
        throw;
    }
    countAgain();
}

void Document::dropUndone() {
    for (std::size_t e = mDone; e < mHistory.size(); ++e) {
        mProfileBytes -= mHistory[e]->profileBytes();
        mOtherBytes -= mHistory[e]->accounted;
    }
    mHistory.resize(mDone);
}

void Document::commit(std::unique_ptr<Entry> entry) {
    static std::atomic<std::uint64_t> latest = 0;
    dropUndone();
    entry->order = ++latest;
    entry->accounted = entry->otherBytes();
    mProfileBytes += entry->profileBytes();
    mOtherBytes += entry->accounted;
    mHistory.push_back(std::move(entry));
    ++mDone;
    trim();
}

void Document::setHistoryBytes(std::size_t bytes) {
    mSettings.historyBytes = bytes;
    trim();
}

void Document::trim() {
    const std::size_t profileBytes = std::min(mSettings.profileBytes, mSettings.historyBytes);
    for (; mTrimmed < mDone && mProfileBytes > profileBytes; ++mTrimmed) {
        Entry& entry = *mHistory[mTrimmed];
        accountFor(entry, [&] {
            tbb::parallel_for(std::size_t{0}, entry.before.size(), [&](std::size_t i) {
                keepOnly(entry.before[i], irreplaceable(mTrimmed, entry.before[i].tile));
            });
        });
    }
    while (historyBytes() > mSettings.historyBytes && mForgotten + 1 < mDone) {
        forgetOldest();
    }
}

/// What later entries would have computed from the oldest one they keep from now on.
void Document::forgetOldest() {
    Entry& oldest = *mHistory[mForgotten];
    std::atomic<std::size_t> moreBytes = 0;
    tbb::parallel_for(std::size_t{0}, oldest.before.size(), [&](std::size_t i) {
        const int tile = oldest.before[i].tile;
        TileBits open = oldest.weighted(tile);
        for (std::size_t e = mForgotten + 1; e < mTrimmed && open.any(); ++e) {
            TileBefore* const before = mHistory[e]->find(tile);
            if (before == nullptr) {
                continue;
            }
            const TileBits touched = open & mHistory[e]->weighted(tile);
            if ((touched & ~before->kept).any()) {
                TileBefore more{tile, {}, {}};
                complete(e, more, before->kept | touched);
                moreBytes += (more.values.size() - before->values.size()) * sizeof(float);
                *before = std::move(more);
            }
            open &= ~touched;
        }
    });
    mProfileBytes += moreBytes;
    accountFor(oldest, [&] {
        oldest.mask = WeightMask();
        oldest.selectionBefore = WeightMask();
        oldest.growth = {};
        oldest.before = {};
    });
    mTrimmed = std::max(mTrimmed, ++mForgotten);
}

/// Texels of a tile whose profile before an entry cannot be computed from earlier ones.
TileBits Document::irreplaceable(std::size_t index, int tile) const {
    TileBits open = mHistory[index]->weighted(tile);
    TileBits kept;
    for (std::size_t e = index; e-- > mForgotten && open.any();) {
        const Entry& earlier = *mHistory[e];
        if (earlier.isSelection()) {
            continue;
        }
        const TileBits touched = open & earlier.weighted(tile);
        if (!isLocal(*operatorOf(earlier.command))) {
            kept |= touched;
        }
        open &= ~touched;
    }
    return kept | open;
}

void Document::keepOnly(TileBefore& before, const TileBits& wanted) {
    if ((before.kept & ~wanted).none()) {
        return;
    }
    const std::size_t count = before.kept.count();
    const std::size_t values = before.values.size() / count;
    std::vector<float> fewer;
    fewer.reserve((before.kept & wanted).count() * values);
    const float* in = before.values.data();
    for (std::size_t cell = 0; cell < before.kept.size(); ++cell) {
        if (before.kept[cell]) {
            if (wanted[cell]) {
                fewer.insert(fewer.end(), in, in + values);
            }
            in += values;
        }
    }
    before.kept &= wanted;
    before.values = std::move(fewer);
}

/// Computes again what trim() has left out of a tile of an entry in effect.
/// @param needed texels that the entry has changed
void Document::complete(std::size_t index, TileBefore& wanted, const TileBits& needed) const {
    const int tile = wanted.tile;
    // Back to the latest profile that is kept of each texel.
    struct Start {
        std::size_t entry = 0;
        const float* values = nullptr;
    };
    std::vector<Start> starts(needed.size());
    TileBits open = needed;
    std::size_t first = index;
    for (std::size_t e = index;; --e) {
        Entry& entry = *mHistory[e];
        if (const TileBefore* before = entry.find(tile)) {
            const std::size_t values =
                before->kept.any() ? before->values.size() / before->kept.count() : 0;
            const float* in = before->values.data();
            for (std::size_t cell = 0; cell < open.size(); ++cell) {
                if (before->kept[cell]) {
                    if (open[cell]) {
                        starts[cell] = {e, in};
                        open[cell] = false;
                        first = e;
                    }
                    in += values;
                }
            }
        }
        if (open.none() || e == mForgotten) {
            break;
        }
    }
    CELADON_ASSERT(open.none());

    // And forward again, through every command that changed them.
    ProfileLayout layout = layoutBefore(first);
    std::vector<std::vector<float>> state(needed.size());
    const TexelRect rect = mSelection.tileRect(tile);
    const MapSource nothing(*mMaterial); // local operators read no other texel
    for (std::size_t e = first; e <= index; ++e) {
        const Entry& entry = *mHistory[e];
        for (const Growth& growth : entry.growth) {
            ProfileEditor editor(growth.to);
            for (std::vector<float>& values : state) {
                if (!values.empty()) {
                    std::vector<float> grown(growth.to.values());
                    growProfile(values.data(), growth.from, editor, growth.to, grown.data());
                    values = std::move(grown);
                }
            }
            layout = growth.to;
        }
        for (std::size_t cell = 0; cell < state.size(); ++cell) {
            if (starts[cell].entry == e && starts[cell].values != nullptr) {
                state[cell].assign(starts[cell].values, starts[cell].values + layout.values());
            }
        }
        if (e == index || entry.isSelection() || entry.mask.tile(tile) == nullptr ||
            !isLocal(*operatorOf(entry.command))) {
            continue; // what follows an operator that looks around has been kept
        }
        const PreparedOperator prepared(*operatorOf(entry.command), layout, mLargestRadiusMm,
                                        *mSurface, nothing);
        PreparedOperator::Worker worker(prepared);
        entry.mask.forEachNonZeroOfTile(tile, [&](std::size_t texel, WeightMask::Weight weight) {
            const auto width = static_cast<std::size_t>(mMaterial->width);
            std::vector<float>& values = state[WeightMask::cell(static_cast<int>(texel % width),
                                                                static_cast<int>(texel / width))];
            if (!values.empty()) {
                worker.evaluate(static_cast<Surface::Texel>(texel), values.data(),
                                weightToFloat(weight), values.data());
            }
        });
    }
    wanted.kept = needed;
    wanted.values.clear();
    wanted.values.reserve(needed.count() * layout.values());
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const std::size_t cell = WeightMask::cell(x, y);
            if (needed[cell]) {
                wanted.values.insert(wanted.values.end(), state[cell].begin(), state[cell].end());
            }
        }
    }
}

/// Of the map before an entry, and so before its growth.
ProfileLayout Document::layoutBefore(std::size_t index) const {
    for (std::size_t e = index; e < mHistory.size(); ++e) {
        if (!mHistory[e]->growth.empty()) {
            return mHistory[e]->growth.front().from;
        }
    }
    return layoutOf(*mMaterial);
}

void Document::restoreTiles(const Entry& entry) {
    const std::size_t values = layoutOf(*mMaterial).values();
    tbb::parallel_for(std::size_t{0}, entry.before.size(), [&](std::size_t i) {
        const float* in = entry.before[i].values.data();
        entry.mask.forEachNonZeroOfTile(entry.before[i].tile, [&](std::size_t texel, auto) {
            std::copy_n(in, values, texelData(texel));
            in += values;
        });
    });
    for (const TileBefore& tile : entry.before) {
        markTile(tile.tile);
    }
}

void Document::undoGrowths(const Entry& entry) {
    for (auto growth = entry.growth.rbegin(); growth != entry.growth.rend(); ++growth) {
        undoGrowth(*mMaterial, *growth);
        mLayoutChanged = true;
        markAll();
    }
}

bool Document::undo(const EditProgress& progress) {
    CELADON_ASSERT(!isStrokeOpen());
    if (!canUndo()) {
        return false;
    }
    Entry& entry = *mHistory[mDone - 1];
    if (entry.isSelection()) {
        setSelection(entry.selectionBefore);
        mTrimmed = std::min(mTrimmed, --mDone);
        return true;
    }
    accountFor(entry, [&] {
        // Tiles are read by their neighbors in time only, not in space: one at a time each.
        std::vector<std::optional<TileBefore>> completed(entry.before.size());
        doTelling(progress, [&] {
            tbb::parallel_for(std::size_t{0}, completed.size(), [&](std::size_t i) {
                const TileBefore& kept = entry.before[i];
                const TileBits changed = entry.weighted(kept.tile);
                if (kept.kept != changed) {
                    complete(mDone - 1, completed[i].emplace(TileBefore{kept.tile, {}, {}}),
                             changed);
                }
            });
            stopPoint();
        });
        for (std::size_t i = 0; i < completed.size(); ++i) {
            if (completed[i]) {
                entry.before[i] = std::move(*completed[i]);
            }
        }
        restoreTiles(entry);
        undoGrowths(entry);
        entry.before.clear(); // doing it again saves them again
        entry.growth.clear();
    });
    mTrimmed = std::min(mTrimmed, --mDone);
    return true;
}

bool Document::redo(const EditProgress& progress) {
    CELADON_ASSERT(!isStrokeOpen());
    if (!canRedo()) {
        return false;
    }
    Entry& entry = *mHistory[mDone];
    if (entry.isSelection()) {
        setSelection(entry.mask);
    } else {
        accountFor(entry, [&] { applyMasked(entry, progress); });
    }
    ++mDone;
    trim();
    return true;
}

const EditCommand* Document::undoCommand() const {
    return canUndo() ? &mHistory[mDone - 1]->command : nullptr;
}

const EditCommand* Document::redoCommand() const {
    return canRedo() ? &mHistory[mDone]->command : nullptr;
}

std::uint64_t Document::undoOrder() const {
    return canUndo() ? mHistory[mDone - 1]->order : 0;
}

std::uint64_t Document::redoOrder() const {
    return canRedo() ? mHistory[mDone]->order : 0;
}

std::uint64_t Document::forgottenOrder() const {
    return mForgotten > 0 ? mHistory[mForgotten - 1]->order : 0;
}

std::uint64_t Document::contentId() const {
    for (std::size_t e = mDone; e-- > 0;) {
        if (!mHistory[e]->isSelection() && mHistory[e]->report.texels > 0) {
            return mHistory[e]->order;
        }
    }
    return 0;
}

std::vector<EditCommand> Document::commands() const {
    std::vector<EditCommand> commands;
    for (std::size_t i = 0; i < mDone; ++i) {
        commands.push_back(mHistory[i]->command);
    }
    return commands;
}

} // namespace celadon::subedit
