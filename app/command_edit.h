#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon edit [MODEL]`: the editor.
[[nodiscard]] Command addEditCommand(CLI::App& root);

} // namespace celadon::app
