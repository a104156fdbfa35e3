#pragma once

#include "ui/preferences.h"

namespace celadon::ui {

/// @param keyWantedFor set when the next key that is pressed is to be an action's
/// @return whether something was changed
bool drawPreferencesWindow(Preferences& preferences, bool& isShown,
                           std::optional<Action>& keyWantedFor, float scale);

} // namespace celadon::ui
