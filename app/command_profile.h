#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon profile make|fit|table|plot|lut|list`: scattering profiles and what is computed from
/// them.
[[nodiscard]] Command addProfileCommand(CLI::App& root);

} // namespace celadon::app
