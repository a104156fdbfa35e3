#pragma once

#include "ui/session.h"

namespace celadon::ui {

/// The primary profile: its curves, its numbers, where to start from, how it looks.
void drawProfilePanel(Session& session);

} // namespace celadon::ui
