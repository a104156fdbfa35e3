#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon material edit`: replays a stroke file on a material, without the editor.
[[nodiscard]] Command addMaterialEdit(CLI::App& material);

} // namespace celadon::app
