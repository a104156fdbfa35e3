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
    [[nodiscard]] std::uint8_t& outcome(std::size_t texel);

    using Outcomes = std::array<std::uint8_t, WeightMask::kTileSize * WeightMask::kTileSize>;

    Document& owner;
    StrokeCommand command;
    StrokeMask dabs;
    Entry entry; ///< its mask and growth so far
    /// Whole tiles as they were before the stroke, [rows][columns][knots][3], of those that it has
    /// touched.
    std::vector<std::vector<float>> backup;
    /// Of each texel of a touched tile: 1 energy clamped, 2 range clamped.
    std::vector<std::unique_ptr<Outcomes>> outcomes;
    std::unique_ptr<PreparedOperator> prepared;
};

} // namespace celadon::subedit
