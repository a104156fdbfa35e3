#pragma once

#include "ui/layout_state.h"

/// What moves the model: playback, the list of deformers, amounts, control points, handles, keys.
namespace celadon::ui {

void drawDeformPanel(const LayoutContext& context);

} // namespace celadon::ui
