#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

/// Tools, operators and their parameters, the brush, the selection, undo and redo.
void drawBrushPanel(const LayoutContext& context);

} // namespace celadon::ui
