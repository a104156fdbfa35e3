#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

/// File, Edit, View, Help at the upper edge.
void drawMenuBar(const LayoutContext& context);

} // namespace celadon::ui
