#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon material bake|info`: SubEdit materials without the editor.
[[nodiscard]] Command addMaterialCommand(CLI::App& root);

} // namespace celadon::app
