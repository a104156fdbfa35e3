#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

/// Exposure, camera, turntable, views that explain, and what the picture cost.
void drawViewPanel(const LayoutContext& context);

} // namespace celadon::ui
