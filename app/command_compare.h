#pragma once

#include "app/command.h"

namespace celadon::app {

/// `celadon compare A B`: how different two pictures are, as numbers and as a heat map.
[[nodiscard]] Command addCompareCommand(CLI::App& root);

} // namespace celadon::app
