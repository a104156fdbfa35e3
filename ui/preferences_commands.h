#pragma once

#include "ui/command.h"
#include "ui/preferences.h"

#include <functional>

namespace celadon::ui {

/// Commands that change what a user has chosen for good. They are not recorded: a replay leaves the
/// preferences alone, unless somebody wrote them into it.
/// @param preferences  outlive the dispatcher
/// @param changed      called after each
void addPreferencesCommands(Dispatcher& commands, Preferences& preferences,
                            std::function<void()> changed);

} // namespace celadon::ui
