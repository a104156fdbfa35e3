#pragma once

#include "ui/key_map.h"

namespace celadon::ui {

/// The shortcuts, over everything.
void drawHelpWindow(const KeyMap& keys, bool& isShown, float scale);

} // namespace celadon::ui
