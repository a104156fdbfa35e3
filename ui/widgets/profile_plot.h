#pragma once

#include "subedit/edit/edit_operator.h"

#include <optional>

/// The curves P(r) of a profile, one per channel, P on a logarithmic scale; knots can be dragged.
namespace celadon::ui {

struct KnotDrag {
    int channel = 0;
    int knot = 0;
    float logValue = 0.0f; ///< ln P, P in 1/mm^2
};

/// @param heightPx of the plot
/// @return the knot that is being dragged, where it is wanted
[[nodiscard]] std::optional<KnotDrag> drawProfilePlot(const subedit::StoredProfile& profile,
                                                      float heightPx);

} // namespace celadon::ui
