#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon profile make|table`: scattering profiles and the tables computed from them.
[[nodiscard]] Command addProfileCommand(CLI::App& root);

} // namespace celadon::app
