#pragma once

#include "ui/session.h"

#include <functional>
#include <string>

namespace celadon::ui {

/// The shipped materials and those of this scene; a click puts one on the model or in the hand.
/// @param putOn opens the model with a material, by name or file
void drawMaterialPanel(Session& session, const std::function<void(const std::string&)>& putOn);

} // namespace celadon::ui
