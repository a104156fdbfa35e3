#pragma once

#include "ui/session.h"

namespace celadon::ui {

/// Lights, presets, environment.
void drawLightPanel(Session& session);

} // namespace celadon::ui
