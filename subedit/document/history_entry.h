#pragma once

#include "subedit/document/document.h"

#include <cstdint>
#include <vector>

/// What one command left behind, so that it can be undone and done again.
namespace celadon::subedit {

/// Profiles of the texels of one tile whose weight is above zero, in the mask's order.
struct TileBefore {
    int tile = 0;
    std::vector<float> values;
};

struct Document::Entry {
    EditCommand command;
    EditReport report;
    WeightMask mask;                ///< of the texels that the command changed, selection included
    std::vector<Growth> growth;     ///< done before the texels were changed, in order
    std::vector<TileBefore> before; ///< after the growth; tiles ascending

    [[nodiscard]] std::size_t bytes() const;
};

} // namespace celadon::subedit
