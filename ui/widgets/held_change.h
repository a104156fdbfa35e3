#pragma once

#include "ui/session.h"

namespace celadon::ui {

/// A change by the widget that was just drawn; while it is held, all of them are one step to undo.
void performHeld(Session& session, Command command);

/// In each frame before widgets are drawn: whether one is still held.
void letGoOfHeld(Session& session);

} // namespace celadon::ui
