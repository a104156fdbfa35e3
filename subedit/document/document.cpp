#include "subedit/document/document.h"

#include "subedit/assert.h"
#include "subedit/document/history_entry.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace celadon::subedit {

namespace {

void add(const TexelOutcome& outcome, EditReport& report) {
    ++report.texels;
    report.energyClamped += outcome.energyClamped ? 1 : 0;
    report.rangeClamped += outcome.rangeClamped ? 1 : 0;
}

/// Neighboring tiles of a row become one rectangle.
std::vector<TexelRect> mergeTiles(const WeightMask& tiles, const std::vector<bool>& isChanged) {
    std::vector<TexelRect> rects;
    for (int t = 0; t < tiles.tileCount(); ++t) {
        if (!isChanged[static_cast<std::size_t>(t)]) {
            continue;
        }
        const TexelRect rect = tiles.tileRect(t);
        if (!rects.empty() && rects.back().y == rect.y && rects.back().right() == rect.x) {
            rects.back().width += rect.width;
        } else {
            rects.push_back(rect);
        }
    }
    return rects;
}

} // namespace

std::size_t Document::Entry::bytes() const {
    std::size_t bytes = sizeof(*this) + mask.ownBytes();
    for (const TileBefore& tile : before) {
        bytes += sizeof(tile) + tile.values.capacity() * sizeof(float);
    }
    for (const Growth& g : growth) {
        bytes += g.before.capacity() * sizeof(float) + g.changedTexels.capacity() * 4;
    }
    if (const auto* stroke = std::get_if<StrokeCommand>(&command)) {
        bytes += stroke->path.capacity() * sizeof(StrokePoint);
    }
    return bytes;
}

/// A stroke that is being painted.
struct Document::OpenStroke {
    OpenStroke(const Document& document, StrokeCommand strokeCommand)
        : command(std::move(strokeCommand)),
          dabs(document.surface(), command.brush, command.mirror),
          prepared(std::make_unique<PreparedOperator>(command.op, layoutOf(document.material()),
                                                      document.mLargestRadiusMm)),
          backup(static_cast<std::size_t>(document.mSelection.tileCount())),
          outcomes(backup.size()) {
        entry.mask = WeightMask(document.material().width, document.material().height);
    }

    using Outcomes = std::array<std::uint8_t, WeightMask::kTileSize * WeightMask::kTileSize>;

    StrokeCommand command;
    StrokeMask dabs;
    std::unique_ptr<PreparedOperator> prepared;
    Entry entry; ///< its mask and growth so far
    /// Whole tiles as they were before the stroke, [rows][columns][knots][3], of those that it has
    /// touched.
    std::vector<std::vector<float>> backup;
    /// Of each texel of a touched tile: 1 energy clamped, 2 range clamped.
    std::vector<std::unique_ptr<Outcomes>> outcomes;
};

Document::Document(MaterialMap material, std::shared_ptr<const Surface> surface,
                   const DocumentSettings& settings)
    : mMaterial(std::make_shared<MaterialMap>(std::move(material))),
      mSurface(std::move(surface)),
      mSettings(settings),
      mLargestRadiusMm(largestRadiusMm(layoutOf(*mMaterial))),
      mSelection(WeightMask::full(mMaterial->width, mMaterial->height)),
      mChangedTiles(static_cast<std::size_t>(mSelection.tileCount()), false) {
    CELADON_ASSERT(mSurface->width() == mMaterial->width &&
                   mSurface->height() == mMaterial->height);
}

Document::~Document() = default;

float* Document::texelData(std::size_t texel) {
    return mMaterial->logProfile.data() + texel * layoutOf(*mMaterial).values();
}

glm::vec3 Document::positionOf(Surface::Texel texel) const {
    const Surface::Texel source = mSurface->sourceOf(texel);
    return source == Surface::kNone ? glm::vec3(0.0f) : mSurface->positionMm(source);
}

void Document::markTile(int tile) {
    mChangedTiles[static_cast<std::size_t>(tile)] = true;
}

void Document::markAll() {
    std::fill(mChangedTiles.begin(), mChangedTiles.end(), true);
}

DocumentChanges Document::takeChanges() {
    DocumentChanges changes{mergeTiles(mSelection, mChangedTiles),
                            std::exchange(mLayoutChanged, false),
                            std::exchange(mSelectionChanged, false)};
    std::fill(mChangedTiles.begin(), mChangedTiles.end(), false);
    return changes;
}

// Whole commands.

EditReport Document::execute(const EditCommand& command) {
    CELADON_ASSERT(!isStrokeOpen());
    auto entry = std::make_unique<Entry>();
    entry->command = command;
    if (const auto* apply = std::get_if<ApplyCommand>(&command)) {
        entry->mask = mSelection;
        entry->report = applyMasked(apply->op, *entry);
    } else {
        const auto& stroke = std::get<StrokeCommand>(command);
        entry->mask = strokeMask(stroke);
        entry->report = applyMasked(stroke.op, *entry);
    }
    const EditReport report = entry->report;
    commit(std::move(entry));
    return report;
}

WeightMask Document::strokeMask(const StrokeCommand& stroke) const {
    StrokeMask dabs(*mSurface, stroke.brush, stroke.mirror);
    for (const StrokePoint& point : stroke.path) {
        dabs.add(point);
    }
    return selectedMask(dabs, dabs.takeChanged());
}

/// Weights of covered texels and the gutters that repeat them.
WeightMask Document::selectedMask(const StrokeMask& stroke,
                                  std::span<const Surface::Texel> texels) const {
    WeightMask mask(mMaterial->width, mMaterial->height);
    for (const Surface::Texel texel : texels) {
        const auto weight = weightFromFloat(stroke.weight(texel) *
                                            weightToFloat(mSelection.at(std::size_t{texel})));
        if (weight == 0) {
            continue;
        }
        mask.set(std::size_t{texel}, weight);
        for (const Surface::Texel background : mSurface->gutterOf(texel)) {
            mask.set(std::size_t{background}, weight);
        }
    }
    return mask;
}

/// The entry's mask is set; fills in what undoing needs.
EditReport Document::applyMasked(const EditOperator& op, Entry& entry) {
    entry.mask.dropZeroTiles();
    EditReport report;
    for (;;) {
        const PreparedOperator prepared(op, layoutOf(*mMaterial), mLargestRadiusMm);
        saveTiles(entry);
        float neededMm = 0.0f;
        report = {};
        evaluateTiles(prepared, entry, report, neededMm);
        const auto grown = grownLayout(layoutOf(*mMaterial), neededMm, mLargestRadiusMm);
        if (!grown) {
            break;
        }
        restoreTiles(entry);
        grow(*grown, entry);
    }
    if (!entry.growth.empty()) {
        report.grownRadiusMm = mMaterial->maxRadiusMm;
    }
    return report;
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
            entry.before.push_back({t, {}});
        }
    }
    const std::size_t values = layoutOf(*mMaterial).values();
    tbb::parallel_for(std::size_t{0}, entry.before.size(), [&](std::size_t i) {
        TileBefore& tile = entry.before[i];
        std::size_t texels = 0;
        entry.mask.forEachNonZeroOfTile(tile.tile, [&](std::size_t, auto) { ++texels; });
        tile.values.resize(texels * values);
        float* out = tile.values.data();
        entry.mask.forEachNonZeroOfTile(tile.tile, [&](std::size_t texel, auto) {
            out = std::copy_n(texelData(texel), values, out);
        });
    });
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

void Document::evaluateTiles(const PreparedOperator& prepared, const Entry& entry,
                             EditReport& report, float& neededMm) {
    std::mutex mutex;
    tbb::enumerable_thread_specific<PreparedOperator::Worker> workers(prepared);
    tbb::parallel_for(std::size_t{0}, entry.before.size(), [&](std::size_t i) {
        PreparedOperator::Worker& worker = workers.local();
        EditReport tileReport;
        float tileNeededMm = 0.0f;
        entry.mask.forEachNonZeroOfTile(entry.before[i].tile, [&](std::size_t texel, auto weight) {
            float* data = texelData(texel);
            const TexelOutcome outcome = worker.evaluate(
                data, weightToFloat(weight), positionOf(static_cast<Surface::Texel>(texel)), data);
            add(outcome, tileReport);
            tileNeededMm = std::max(tileNeededMm, outcome.neededRadiusMm);
        });
        const std::lock_guard lock(mutex);
        report.texels += tileReport.texels;
        report.energyClamped += tileReport.energyClamped;
        report.rangeClamped += tileReport.rangeClamped;
        neededMm = std::max(neededMm, tileNeededMm);
    });
    for (const TileBefore& tile : entry.before) {
        markTile(tile.tile);
    }
}

void Document::commit(std::unique_ptr<Entry> entry) {
    mHistory.resize(mDone);
    mHistory.push_back(std::move(entry));
    ++mDone;
}

// Strokes as they happen.

void Document::beginStroke(StrokeCommand stroke) {
    CELADON_ASSERT(!isStrokeOpen());
    const std::vector<StrokePoint> path = std::exchange(stroke.path, {});
    mStroke = std::make_unique<OpenStroke>(*this, std::move(stroke));
    for (const StrokePoint& point : path) {
        addStrokePoint(point);
    }
}

void Document::addStrokePoint(const StrokePoint& point) {
    CELADON_ASSERT(isStrokeOpen());
    mStroke->command.path.push_back(point);
    mStroke->dabs.add(point);

    std::vector<std::size_t> texels;
    for (const Surface::Texel texel : mStroke->dabs.takeChanged()) {
        const auto weight = weightFromFloat(mStroke->dabs.weight(texel) *
                                            weightToFloat(mSelection.at(std::size_t{texel})));
        if (weight == 0) {
            continue;
        }
        const auto touch = [&](Surface::Texel t) {
            mStroke->entry.mask.set(std::size_t{t}, weight);
            texels.push_back(t);
        };
        touch(texel);
        for (const Surface::Texel background : mSurface->gutterOf(texel)) {
            touch(background);
        }
    }
    backUpTiles(texels);
    float neededMm = evaluateStroke(texels);
    while (const auto grown = grownLayout(layoutOf(*mMaterial), neededMm, mLargestRadiusMm)) {
        restoreStroke();
        grow(*grown, mStroke->entry);
        mStroke->prepared = std::make_unique<PreparedOperator>(
            mStroke->command.op, layoutOf(*mMaterial), mLargestRadiusMm);
        std::fill(mStroke->backup.begin(), mStroke->backup.end(), std::vector<float>());
        texels.clear();
        mStroke->entry.mask.forEachNonZero(
            [&](std::size_t texel, auto) { texels.push_back(texel); });
        backUpTiles(texels);
        neededMm = evaluateStroke(texels);
    }
}

/// Copies the tiles of these texels that the stroke has not touched before.
void Document::backUpTiles(std::span<const std::size_t> texels) {
    const std::size_t values = layoutOf(*mMaterial).values();
    const auto width = static_cast<std::size_t>(mMaterial->width);
    for (const std::size_t texel : texels) {
        const int tile =
            mSelection.tileOf(static_cast<int>(texel % width), static_cast<int>(texel / width));
        markTile(tile);
        std::vector<float>& backup = mStroke->backup[static_cast<std::size_t>(tile)];
        if (!backup.empty()) {
            continue;
        }
        const TexelRect rect = mSelection.tileRect(tile);
        backup.resize(rect.texels() * values);
        for (int y = 0; y < rect.height; ++y) {
            const float* row = texelData(static_cast<std::size_t>(rect.y + y) * width +
                                         static_cast<std::size_t>(rect.x));
            const std::size_t count = static_cast<std::size_t>(rect.width) * values;
            std::copy_n(row, count, backup.data() + static_cast<std::size_t>(y) * count);
        }
        auto& outcomes = mStroke->outcomes[static_cast<std::size_t>(tile)];
        if (outcomes == nullptr) {
            outcomes = std::make_unique<OpenStroke::Outcomes>();
        }
    }
}

const float* Document::backupOf(std::size_t texel, int& tile, std::size_t& cell) const {
    const auto width = static_cast<std::size_t>(mMaterial->width);
    const int x = static_cast<int>(texel % width);
    const int y = static_cast<int>(texel / width);
    tile = mSelection.tileOf(x, y);
    const TexelRect rect = mSelection.tileRect(tile);
    cell = static_cast<std::size_t>((y - rect.y) * rect.width + (x - rect.x));
    return mStroke->backup[static_cast<std::size_t>(tile)].data() +
           cell * layoutOf(*mMaterial).values();
}

/// Texels anew from what they were before the stroke and the weights that they have now.
/// @return the r_s that they need
float Document::evaluateStroke(std::span<const std::size_t> texels) {
    std::mutex mutex;
    float neededMm = 0.0f;
    tbb::enumerable_thread_specific<PreparedOperator::Worker> workers(*mStroke->prepared);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels.size(), 128),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          PreparedOperator::Worker& worker = workers.local();
                          float needed = 0.0f;
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              int tile = 0;
                              std::size_t cell = 0;
                              const float* before = backupOf(texels[i], tile, cell);
                              const TexelOutcome outcome = worker.evaluate(
                                  before, weightToFloat(mStroke->entry.mask.at(texels[i])),
                                  positionOf(static_cast<Surface::Texel>(texels[i])),
                                  texelData(texels[i]));
                              (*mStroke->outcomes[static_cast<std::size_t>(tile)])[cell] =
                                  static_cast<std::uint8_t>((outcome.energyClamped ? 1 : 0) |
                                                            (outcome.rangeClamped ? 2 : 0));
                              needed = std::max(needed, outcome.neededRadiusMm);
                          }
                          const std::lock_guard lock(mutex);
                          neededMm = std::max(neededMm, needed);
                      });
    return neededMm;
}

void Document::restoreStroke() {
    const std::size_t values = layoutOf(*mMaterial).values();
    mStroke->entry.mask.forEachNonZero([&](std::size_t texel, auto) {
        int tile = 0;
        std::size_t cell = 0;
        const float* before = backupOf(texel, tile, cell);
        std::copy_n(before, values, texelData(texel));
        markTile(tile);
    });
}

void Document::undoGrowths(const Entry& entry) {
    for (auto growth = entry.growth.rbegin(); growth != entry.growth.rend(); ++growth) {
        undoGrowth(*mMaterial, *growth);
        mLayoutChanged = true;
        markAll();
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
    entry->mask.dropZeroTiles();
    const std::size_t values = layoutOf(*mMaterial).values();
    for (int t = 0; t < entry->mask.tileCount(); ++t) {
        if (entry->mask.tile(t) == nullptr) {
            continue;
        }
        TileBefore before{t, {}};
        entry->mask.forEachNonZeroOfTile(t, [&](std::size_t texel, auto) {
            int tile = 0;
            std::size_t cell = 0;
            const float* data = backupOf(texel, tile, cell);
            before.values.insert(before.values.end(), data, data + values);
            const std::uint8_t outcome = (*mStroke->outcomes[static_cast<std::size_t>(t)])[cell];
            add({(outcome & 1) != 0, (outcome & 2) != 0, 0.0f}, entry->report);
        });
        before.values.shrink_to_fit();
        entry->before.push_back(std::move(before));
    }
    entry->command = std::move(mStroke->command);
    mStroke.reset();
    const EditReport report = entry->report;
    commit(std::move(entry));
    return report;
}

// History.

bool Document::undo() {
    CELADON_ASSERT(!isStrokeOpen());
    if (!canUndo()) {
        return false;
    }
    const Entry& entry = *mHistory[--mDone];
    restoreTiles(entry);
    undoGrowths(entry);
    return true;
}

bool Document::redo() {
    CELADON_ASSERT(!isStrokeOpen());
    if (!canRedo()) {
        return false;
    }
    Entry& entry = *mHistory[mDone++];
    entry.growth.clear();
    const auto& op = std::visit(
        [](const auto& command) -> const EditOperator& { return command.op; }, entry.command);
    entry.report = applyMasked(op, entry);
    return true;
}

std::string Document::undoTitle() const {
    return canUndo() ? commandTitle(mHistory[mDone - 1]->command) : std::string();
}

std::string Document::redoTitle() const {
    return canRedo() ? commandTitle(mHistory[mDone]->command) : std::string();
}

std::vector<EditCommand> Document::commands() const {
    std::vector<EditCommand> commands;
    for (std::size_t i = 0; i < mDone; ++i) {
        commands.push_back(mHistory[i]->command);
    }
    return commands;
}

std::size_t Document::historyBytes() const {
    std::size_t bytes = 0;
    for (const auto& entry : mHistory) {
        bytes += entry->bytes();
    }
    return bytes;
}

} // namespace celadon::subedit
