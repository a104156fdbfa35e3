#pragma once

#include "subedit/document/document.h"

#include <bitset>
#include <vector>

/// What one command left behind, so that it can be undone and done again.
namespace celadon::subedit {

using TileBits = std::bitset<WeightMask::kTileSize * WeightMask::kTileSize>;

/// Profiles of texels of one tile as they were before a command. All texels that it changed, or,
/// once the history has been trimmed, only those that nothing else could give back.
struct TileBefore {
    int tile = 0;
    TileBits kept;             ///< which texels: by row and column in a tile of full size
    std::vector<float> values; ///< theirs, in that order
};

struct Document::Entry {
    EditCommand command;
    EditReport report;
    /// Of the texels that the command changed, selection included. A SelectCommand: the selection
    /// after it.
    WeightMask mask;
    WeightMask selectionBefore;     ///< of a SelectCommand
    std::vector<Growth> growth;     ///< done before the texels were changed, in order
    std::vector<TileBefore> before; ///< after the growth; tiles ascending
    std::uint64_t order = 0;        ///< among the commands of all documents
    std::size_t accounted = 0;      ///< otherBytes() as the history counts it

    [[nodiscard]] bool isSelection() const {
        return std::holds_alternative<SelectCommand>(command);
    }
    /// Null if the command did not touch the tile.
    [[nodiscard]] TileBefore* find(int tile);
    /// Which texels of a tile have a weight.
    [[nodiscard]] TileBits weighted(int tile) const;

    /// Memory for profiles, and for all else.
    [[nodiscard]] std::size_t profileBytes() const;
    [[nodiscard]] std::size_t otherBytes() const;
};

} // namespace celadon::subedit
