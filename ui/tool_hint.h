#pragma once

#include "ui/session.h"

#include <string>

namespace celadon::ui {

/// What the mouse would do over the surface with the tool at hand, in a few words.
[[nodiscard]] std::string toolHint(const Session& session);

} // namespace celadon::ui
