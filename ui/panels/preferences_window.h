#pragma once

#include "ui/preferences.h"

namespace celadon::ui {

/// @return whether something was changed
bool drawPreferencesWindow(Preferences& preferences, bool& isShown, float scale);

} // namespace celadon::ui
