#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

[[nodiscard]] float statusBarHeight(float scale);

/// At the lower edge: what is open, the job under way with its progress, how the picture was made.
void drawStatusBar(const LayoutContext& context);

/// In a corner of the viewport: what the mouse does now, and what is shown.
void drawViewportHint(const LayoutContext& context);

} // namespace celadon::ui
