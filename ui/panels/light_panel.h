#pragma once

#include "ui/layout_state.h"
#include "ui/session.h"

namespace celadon::ui {

/// Lights, presets, environment.
void drawLightPanel(Session& session, const LayoutActions& actions);

} // namespace celadon::ui
