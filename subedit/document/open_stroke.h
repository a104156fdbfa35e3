#pragma once

#include "subedit/document/document.h"
#include "subedit/document/history_entry.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace celadon::subedit {

/// A stroke that is being painted, and the map as it was before it.
struct Document::OpenStroke : ProfileSource {
    OpenStroke(Document& document, StrokeCommand strokeCommand);
    /// The operator for the map's layout as it is now.
    void prepare();
    [[nodiscard]] const float* profile(Surface::Texel texel) const override;
    /// Saves a texel that it has not touched yet.
    void save(std::size_t texel);
    [[nodiscard]] std::uint8_t& outcome(std::size_t texel);

    Document& owner;
    StrokeCommand command;
    StrokeMask dabs;
    Entry entry; ///< its mask and growth so far
    /// What the stroke has touched of a tile, as it was before.
    struct Tile {
        TileBits saved;
        /// Room for all its texels, so that none ever moves; memory is taken only by those saved.
        std::unique_ptr<float[]> values;
        std::array<std::uint8_t, WeightMask::kTileSize * WeightMask::kTileSize>
            outcome; ///< 1 energy clamped, 2 range clamped
    };
    std::vector<std::unique_ptr<Tile>> tiles;
    std::unique_ptr<PreparedOperator> prepared;
};

} // namespace celadon::subedit
