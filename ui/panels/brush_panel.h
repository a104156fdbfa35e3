#pragma once

#include "ui/session.h"

namespace celadon::ui {

/// Tool, operator, brush, undo.
void drawBrushPanel(Session& session);

} // namespace celadon::ui
