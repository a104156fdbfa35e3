#pragma once

#include "subedit/document/edit_command.h"
#include "subedit/document/edit_progress.h"
#include "subedit/document/profile_arena.h"
#include "subedit/edit/apply_operator.h"
#include "subedit/edit/grow_radius.h"
#include "subedit/map/material_map.h"
#include "subedit/paint/stroke_mask.h"
#include "subedit/paint/surface.h"
#include "subedit/select/weight_mask.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// A material that is being edited: the map, its selection, and its history. All changes are
/// commands; undo gives back the bytes that were there. What has changed is reported in rectangles,
/// so that textures and tables need only follow.
namespace celadon::subedit {

struct DocumentSettings {
    /// Profiles kept as they were before edits, for undoing at once. Beyond it the oldest go, and
    /// are computed again from older ones and the commands between when they are needed.
    std::size_t profileBytes = std::size_t{192} << 20;
    /// All that undoing may take, of profiles and of what is needed to compute them again. Beyond
    /// it the oldest commands can no longer be undone; the latest always can.
    std::size_t historyBytes = std::size_t{512} << 20;
};

/// What a command did.
struct EditReport {
    std::size_t texels = 0;        ///< with a weight above zero
    std::size_t energyClamped = 0; ///< texels whose albedo would have been above 1
    std::size_t rangeClamped = 0;  ///< texels whose range would have needed more than the limit
    std::optional<float> grownRadiusMm; ///< r_s, if it had to grow

    void add(const TexelOutcome& outcome) {
        ++texels;
        energyClamped += outcome.energyClamped ? 1 : 0;
        rangeClamped += outcome.rangeClamped ? 1 : 0;
    }
};

struct TileBefore;

/// What has changed since takeChanges() was last called.
struct DocumentChanges {
    std::vector<TexelRect> rects; ///< of the map; none overlap
    bool layoutChanged = false;   ///< segments and r_s: everything must be read anew
    bool selectionChanged = false;
    [[nodiscard]] bool isEmpty() const {
        return rects.empty() && !layoutChanged && !selectionChanged;
    }
};

class Document {
public:
    /// @param surface as large as the map
    Document(MaterialMap material, std::shared_ptr<const Surface> surface,
             const DocumentSettings& settings = {});
    ~Document();
    Document(const Document&) = delete;
    Document& operator=(const Document&) = delete;

    [[nodiscard]] const MaterialMap& material() const { return *mMaterial; }
    [[nodiscard]] const Surface& surface() const { return *mSurface; }
    [[nodiscard]] std::shared_ptr<const Surface> surfacePointer() const { return mSurface; }
    [[nodiscard]] const WeightMask& selection() const { return mSelection; }

    /// What it is called in files and lists. No edit: it cannot be undone.
    void rename(const std::string& name) { mMaterial->name = name; }

    /// Selects what another one selects, of a map as large. No edit: it cannot be undone.
    void takeSelection(const Document& other);

    /// Does a whole command; what was undone before can no longer be redone.
    EditReport execute(const EditCommand& command, const EditProgress& progress = {});

    /// A stroke as it happens: the map follows every point. Between begin and end nothing else may
    /// change the document. The result has the same bytes as execute() of the whole stroke.
    /// @param stroke its path may hold the first points
    void beginStroke(StrokeCommand stroke);
    void addStrokePoint(const StrokePoint& point);
    EditReport endStroke();
    /// As if it had never begun.
    void cancelStroke();
    [[nodiscard]] bool isStrokeOpen() const { return mStroke != nullptr; }

    [[nodiscard]] bool canUndo() const { return mDone > mForgotten; }
    [[nodiscard]] bool canRedo() const { return mDone < mHistory.size(); }
    /// Both may take long: what was left out of the history is computed again.
    /// @return whether there was anything to undo
    bool undo(const EditProgress& progress = {});
    bool redo(const EditProgress& progress = {});
    /// The command that undo() or redo() would take back or repeat; null: there is none.
    [[nodiscard]] const EditCommand* undoCommand() const;
    [[nodiscard]] const EditCommand* redoCommand() const;
    /// When the command was first done that undo() would take back, or redo() repeat: commands of
    /// all documents are numbered in their order. 0: there is none.
    [[nodiscard]] std::uint64_t undoOrder() const;
    [[nodiscard]] std::uint64_t redoOrder() const;
    /// The same of the latest command that can no longer be undone.
    [[nodiscard]] std::uint64_t forgottenOrder() const;
    /// What was undone can no longer be redone.
    void dropUndone();
    /// The same number, the same material: that of the latest command in effect which is more than
    /// a selection; 0 as opened.
    [[nodiscard]] std::uint64_t contentId() const;
    /// Commands in effect, oldest first: replayed on the material as opened they give this one.
    [[nodiscard]] std::vector<EditCommand> commands() const;
    [[nodiscard]] std::size_t commandCount() const { return mDone; }

    [[nodiscard]] DocumentChanges takeChanges();

    /// Memory that the history takes.
    [[nodiscard]] std::size_t historyBytes() const { return mProfileBytes + mOtherBytes; }
    /// From now on, see DocumentSettings.
    void setHistoryBytes(std::size_t bytes);

private:
    struct Entry;
    struct OpenStroke;
    class EntrySource;
    friend struct OpenStroke;

    // Doing (document.cpp).
    [[nodiscard]] WeightMask reached(const EditCommand& command) const;
    [[nodiscard]] WeightMask strokeMask(const StrokeCommand& stroke) const;
    bool setStrokeWeight(const StrokeMask& dabs, Surface::Texel texel, WeightMask& mask) const;
    [[nodiscard]] WeightMask selected(const WeightMask& mask) const;
    void setSelection(const WeightMask& selection);
    void applyMasked(Entry& entry, const EditProgress& progress = {});
    void saveTiles(Entry& entry);
    float evaluateTiles(const PreparedOperator& prepared, Entry& entry,
                        const EditProgress& progress);
    void grow(const ProfileLayout& to, Entry& entry);
    void markTile(int tile);
    void markTexel(int tile, int x, int y);
    void markAll();
    [[nodiscard]] float* texelData(std::size_t texel);

    // The stroke in hand (document_stroke.cpp).
    float evaluateStroke(std::span<const std::size_t> texels);
    void restoreStroke();

    // Undoing (document_history.cpp).
    void commit(std::unique_ptr<Entry> entry);
    template<typename Change>
    void accountFor(Entry& entry, Change&& change);
    void trim();
    void forgetOldest();
    [[nodiscard]] std::bitset<WeightMask::kTileSize * WeightMask::kTileSize>
    irreplaceable(std::size_t index, int tile) const;
    static void keepOnly(TileBefore& before,
                         const std::bitset<WeightMask::kTileSize * WeightMask::kTileSize>& wanted);
    void complete(std::size_t index, TileBefore& wanted,
                  const std::bitset<WeightMask::kTileSize * WeightMask::kTileSize>& needed) const;
    [[nodiscard]] ProfileLayout layoutBefore(std::size_t index) const;
    void restoreTiles(const Entry& entry);
    void undoGrowths(const Entry& entry);

    std::shared_ptr<MaterialMap> mMaterial;
    std::shared_ptr<const Surface> mSurface;
    DocumentSettings mSettings;
    float mLargestRadiusMm;
    WeightMask mSelection;

    std::vector<std::unique_ptr<Entry>> mHistory;
    std::size_t mDone = 0;         ///< entries in effect; the rest can be redone
    std::size_t mForgotten = 0;    ///< entries that can no longer be undone: their commands only
    std::size_t mTrimmed = 0;      ///< entries that keep only what is irreplaceable
    std::size_t mProfileBytes = 0; ///< of all profiles that entries keep
    std::size_t mOtherBytes = 0;   ///< of all else
    std::unique_ptr<OpenStroke> mStroke;
    ProfileArena mSetAside; ///< by the open stroke; its memory serves the next one

    std::vector<TexelRect> mChanged; ///< within each tile
    bool mLayoutChanged = false;
    bool mSelectionChanged = false;
};

} // namespace celadon::subedit
