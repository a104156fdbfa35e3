#pragma once

#include "ui/layout_state.h"

/// The frame around the viewport: menu bar, side bar with its tabs, status bar, notices.
namespace celadon::ui {

/// Where the viewport is, given what is shown.
[[nodiscard]] ViewportRect viewportRect(glm::ivec2 windowPx, const LayoutState& state, float scale);

void drawLayout(const LayoutContext& context);

} // namespace celadon::ui
