#pragma once

#include "app/command.h"

/// The subcommands of `celadon profile`, each in its own file.
namespace celadon::app {

[[nodiscard]] Command addProfileMake(CLI::App& profile);
[[nodiscard]] Command addProfileFit(CLI::App& profile);
[[nodiscard]] Command addProfileTable(CLI::App& profile);
[[nodiscard]] Command addProfilePlot(CLI::App& profile);
[[nodiscard]] Command addProfileLut(CLI::App& profile);
[[nodiscard]] Command addProfileList(CLI::App& profile);

} // namespace celadon::app
