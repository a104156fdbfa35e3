#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon bench`: speed and quality, side by side in one run.
[[nodiscard]] Command addBenchCommand(CLI::App& root);

} // namespace celadon::app
