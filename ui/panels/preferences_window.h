#pragma once

#include "ui/layout_state.h"

namespace celadon::ui {

void drawPreferencesWindow(const LayoutContext& context);

} // namespace celadon::ui
