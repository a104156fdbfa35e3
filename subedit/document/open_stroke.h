#pragma once

#include "subedit/document/document.h"
#include "subedit/document/history_entry.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace celadon::subedit {

/// A stroke that is being painted, and the map as it was before it.
struct Document::OpenStroke : ProfileSource {
    OpenStroke(Document& document, StrokeCommand strokeCommand);
    /// The operator for the map's layout as it is now.
    void prepare();
    [[nodiscard]] const float* profile(Surface::Texel texel) const override;
    /// What a texel is computed from and into.
    struct Target {
        Surface::Texel texel;
        WeightMask::Weight weight;
        const float* before;
        float* after;
        std::uint8_t* outcome;
    };
    /// Sets aside texels that it has not touched yet.
    [[nodiscard]] std::vector<Target> save(std::span<const std::size_t> texels);
    /// Forgets what was set aside: the map is as it was.
    void forget();
    [[nodiscard]] std::uint8_t& outcome(std::size_t texel);

    Document& owner;
    StrokeCommand command;
    StrokeMask dabs;
    Entry entry; ///< its mask and growth so far
    /// What the stroke has touched of a tile.
    struct Tile {
        /// As it was before; null: not touched.
        std::array<float*, WeightMask::kTileSize * WeightMask::kTileSize> before{};
        std::array<std::uint8_t, WeightMask::kTileSize * WeightMask::kTileSize>
            outcome; ///< 1 energy clamped, 2 range clamped
    };
    std::vector<std::unique_ptr<Tile>> tiles;
    std::unique_ptr<PreparedOperator> prepared;
};

} // namespace celadon::subedit
