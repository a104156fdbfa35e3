#pragma once

namespace celadon::ui {

/// The shortcuts, over everything.
void drawHelpWindow(bool& isShown, float scale);

} // namespace celadon::ui
