#pragma once

#include "ui/session.h"
#include "ui/viewport.h"

namespace celadon::ui {

/// Camera, display, views that explain, timings.
void drawViewPanel(Session& session, const Viewport& viewport);

} // namespace celadon::ui
