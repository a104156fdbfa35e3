#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

/// Messages over the viewport, each with a button that dismisses it. What merely informs goes by
/// itself.
void drawNotices(const LayoutContext& context);

} // namespace celadon::ui
