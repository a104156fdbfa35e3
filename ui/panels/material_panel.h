#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

/// What is being painted on, and a browser of materials with pictures.
void drawMaterialPanel(const LayoutContext& context);

} // namespace celadon::ui
