#include "subedit/document/document.h"

#include "subedit/assert.h"
#include "subedit/document/open_stroke.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace celadon::subedit {

namespace {

/// Neighbors in a row of tiles become one rectangle where they are as high.
std::vector<TexelRect> merged(const std::vector<TexelRect>& rectOfTile) {
    std::vector<TexelRect> rects;
    for (const TexelRect& rect : rectOfTile) {
        if (rect.isEmpty()) {
            continue;
        }
        if (!rects.empty() && rects.back().y == rect.y && rects.back().height == rect.height &&
            rects.back().right() == rect.x) {
            rects.back().width += rect.width;
        } else {
            rects.push_back(rect);
        }
    }
    return rects;
}

} // namespace

/// The map as it was before an entry's command, while that is being done: what has been saved of
/// the texels that it changes, the map itself for all others.
class Document::EntrySource : public ProfileSource {
public:
    EntrySource(const MaterialMap& map, const Entry& entry, bool isNeeded)
        : mMap(map),
          mMask(entry.mask),
          mValues(layoutOf(map).values()),
          mTiles(static_cast<std::size_t>(entry.mask.tileCount())) {
        if (!isNeeded) {
            return;
        }
        for (const TileBefore& before : entry.before) {
            Tile& tile = mTiles[static_cast<std::size_t>(before.tile)];
            tile.values = before.values.data();
            tile.rank.resize(before.kept.size());
            std::uint16_t rank = 0;
            for (std::size_t cell = 0; cell < before.kept.size(); ++cell) {
                tile.rank[cell] = before.kept[cell] ? rank++ : kNotSaved;
            }
        }
    }

    [[nodiscard]] const float* profile(Surface::Texel texel) const override {
        const auto width = static_cast<Surface::Texel>(mMap.width);
        const int x = static_cast<int>(texel % width);
        const int y = static_cast<int>(texel / width);
        const Tile& tile = mTiles[static_cast<std::size_t>(mMask.tileOf(x, y))];
        if (!tile.rank.empty()) {
            const std::uint16_t rank = tile.rank[WeightMask::cell(x, y)];
            if (rank != kNotSaved) {
                return tile.values + rank * mValues;
            }
        }
        return mMap.logProfile.data() + texel * mValues;
    }

private:
    static constexpr std::uint16_t kNotSaved = 0xffff;
    struct Tile {
        const float* values = nullptr;
        std::vector<std::uint16_t> rank; ///< of each texel of the tile among the saved ones
    };
    const MaterialMap& mMap;
    const WeightMask& mMask;
    std::size_t mValues;
    std::vector<Tile> mTiles;
};

Document::Document(MaterialMap material, std::shared_ptr<const Surface> surface,
                   const DocumentSettings& settings)
    : mMaterial(std::make_shared<MaterialMap>(std::move(material))),
      mSurface(std::move(surface)),
      mSettings(settings),
      mLargestRadiusMm(largestRadiusMm(layoutOf(*mMaterial))),
      mSelection(WeightMask::full(mMaterial->width, mMaterial->height)),
      mChanged(static_cast<std::size_t>(mSelection.tileCount())) {
    CELADON_ASSERT(mSurface->width() == mMaterial->width &&
                   mSurface->height() == mMaterial->height);
}

float* Document::texelData(std::size_t texel) {
    return mMaterial->logProfile.data() + texel * layoutOf(*mMaterial).values();
}

void Document::markTile(int tile) {
    mChanged[static_cast<std::size_t>(tile)] = mSelection.tileRect(tile);
}

void Document::markTexel(int tile, int x, int y) {
    TexelRect& rect = mChanged[static_cast<std::size_t>(tile)];
    rect = unite(rect, {x, y, 1, 1});
}

void Document::markAll() {
    for (int t = 0; t < mSelection.tileCount(); ++t) {
        markTile(t);
    }
}

DocumentChanges Document::takeChanges() {
    DocumentChanges changes{merged(mChanged), std::exchange(mLayoutChanged, false),
                            std::exchange(mSelectionChanged, false)};
    std::fill(mChanged.begin(), mChanged.end(), TexelRect{});
    return changes;
}

EditReport Document::execute(const EditCommand& command, const EditProgress& progress) {
    CELADON_ASSERT(!isStrokeOpen());
    auto entry = std::make_unique<Entry>();
    entry->command = command;
    doTelling(progress, [&] { entry->mask = reached(command); });
    if (entry->isSelection()) {
        entry->selectionBefore = mSelection;
        setSelection(entry->mask);
    } else {
        entry->mask.compact(mSelection);
        applyMasked(*entry, progress);
    }
    const EditReport report = entry->report;
    commit(std::move(entry));
    return report;
}

/// What a command reaches, and how much; of a selection, the one that it leads to.
WeightMask Document::reached(const EditCommand& command) const {
    if (const auto* step = std::get_if<SelectCommand>(&command)) {
        return select(*mMaterial, *mSurface, mSelection, step->step, step->mode);
    }
    if (const auto* stroke = std::get_if<StrokeCommand>(&command)) {
        return strokeMask(*stroke);
    }
    if (const auto* spread = std::get_if<PropagateCommand>(&command)) {
        return selected(propagate(*mMaterial, *mSurface, spread->propagation));
    }
    if (const auto* picture = std::get_if<StampCommand>(&command)) {
        return selected(stampMask(*mSurface, picture->stamp));
    }
    return mSelection;
}

void Document::takeSelection(const Document& other) {
    if (other.mSelection.width() == mSelection.width() &&
        other.mSelection.height() == mSelection.height()) {
        setSelection(other.mSelection);
    }
}

void Document::setSelection(const WeightMask& selection) {
    mSelection = selection;
    mSelectionChanged = true;
}

WeightMask Document::strokeMask(const StrokeCommand& stroke) const {
    StrokeMask dabs(*mSurface, stroke.brush, stroke.mirror);
    for (const StrokePoint& point : stroke.path) {
        dabs.add(point);
    }
    WeightMask mask(mMaterial->width, mMaterial->height);
    for (const Surface::Texel texel : dabs.takeChanged()) {
        setStrokeWeight(dabs, texel, mask);
    }
    return mask;
}

/// Sets the weight of a covered texel, and of the gutters that repeat it.
/// @return whether it has any
bool Document::setStrokeWeight(const StrokeMask& dabs, Surface::Texel texel,
                               WeightMask& mask) const {
    const auto weight =
        weightFromFloat(dabs.weight(texel) * weightToFloat(mSelection.at(std::size_t{texel})));
    if (weight == 0) {
        return false;
    }
    mask.set(std::size_t{texel}, weight);
    for (const Surface::Texel background : mSurface->gutterOf(texel)) {
        mask.set(std::size_t{background}, weight);
    }
    return true;
}

WeightMask Document::selected(const WeightMask& mask) const {
    WeightMask result(mask.width(), mask.height());
    mask.forEachNonZero([&](std::size_t texel, WeightMask::Weight weight) {
        result.set(texel,
                   weightFromFloat(weightToFloat(weight) * weightToFloat(mSelection.at(texel))));
    });
    return result;
}

/// The entry's command and mask are set; changes the map and fills in what undoing needs.
void Document::applyMasked(Entry& entry, const EditProgress& progress) {
    const EditOperator& op = *operatorOf(entry.command);
    bool isSaved = false;
    try {
        for (;;) {
            doTelling(progress, [&] { saveTiles(entry); });
            isSaved = true;
            const EntrySource source(*mMaterial, entry, !isLocal(op));
            std::optional<PreparedOperator> prepared;
            doTelling(progress, [&] {
                prepared.emplace(op, layoutOf(*mMaterial), mLargestRadiusMm, *mSurface, source);
            });
            entry.report = {};
            const float neededMm = evaluateTiles(*prepared, entry, progress);
            const auto grown = grownLayout(layoutOf(*mMaterial), neededMm, mLargestRadiusMm);
            if (!grown) {
                break;
            }
            restoreTiles(entry);
            isSaved = false;
            grow(*grown, entry);
        }
    } catch (...) {
        if (isSaved) {
            restoreTiles(entry);
        }
        undoGrowths(entry);
        entry.before.clear(); // it may be done again
        entry.growth.clear();
        throw;
    }
    if (!entry.growth.empty()) {
        entry.report.grownRadiusMm = mMaterial->maxRadiusMm;
    }
}

void Document::grow(const ProfileLayout& to, Entry& entry) {
    entry.growth.push_back(growRadius(*mMaterial, to));
    mLayoutChanged = true;
    markAll();
}

void Document::saveTiles(Entry& entry) {
    entry.before.clear();
    for (int t = 0; t < entry.mask.tileCount(); ++t) {
        if (entry.mask.tile(t) != nullptr) {
            entry.before.push_back({t, entry.weighted(t), {}});
        }
    }
    const std::size_t values = layoutOf(*mMaterial).values();
    tbb::parallel_for(std::size_t{0}, entry.before.size(), [&](std::size_t i) {
        TileBefore& tile = entry.before[i];
        tile.values.resize(tile.kept.count() * values);
        float* out = tile.values.data();
        entry.mask.forEachNonZeroOfTile(tile.tile, [&](std::size_t texel, auto) {
            out = std::copy_n(texelData(texel), values, out);
        });
    });
}

/// @return the r_s that the result needs
float Document::evaluateTiles(const PreparedOperator& prepared, Entry& entry,
                              const EditProgress& progress) {
    std::mutex mutex;
    float neededMm = 0.0f;
    tbb::enumerable_thread_specific<PreparedOperator::Worker> workers(
        [&] { return PreparedOperator::Worker(prepared); });
    const auto evaluate = [&](std::size_t i) {
        PreparedOperator::Worker& worker = workers.local();
        EditReport report;
        float tileNeededMm = 0.0f;
        entry.mask.forEachNonZeroOfTile(entry.before[i].tile, [&](std::size_t texel, auto weight) {
            float* data = texelData(texel);
            const TexelOutcome outcome = worker.evaluate(static_cast<Surface::Texel>(texel), data,
                                                         weightToFloat(weight), data);
            report.add(outcome);
            tileNeededMm = std::max(tileNeededMm, outcome.neededRadiusMm);
        });
        const std::lock_guard lock(mutex);
        entry.report.texels += report.texels;
        entry.report.energyClamped += report.energyClamped;
        entry.report.rangeClamped += report.rangeClamped;
        neededMm = std::max(neededMm, tileNeededMm);
    };
    constexpr std::size_t kTilesBetween = 16;
    const std::size_t count = entry.before.size();
    const std::size_t step = progress ? kTilesBetween : std::max<std::size_t>(count, 1);
    for (std::size_t from = 0; from < count; from += step) {
        tbb::parallel_for(from, std::min(from + step, count), evaluate);
        if (progress) {
            progress(static_cast<float>(std::min(from + step, count)) / static_cast<float>(count));
        }
    }
    for (const TileBefore& tile : entry.before) {
        markTile(tile.tile);
    }
    return neededMm;
}

} // namespace celadon::subedit
