#pragma once

#include "app/command.h"

/// The subcommands of `celadon material`, each in its own file.
namespace celadon::app {

[[nodiscard]] Command addMaterialBake(CLI::App& material);
[[nodiscard]] Command addMaterialInfo(CLI::App& material);
[[nodiscard]] Command addMaterialConvert(CLI::App& material);
[[nodiscard]] Command addMaterialFit(CLI::App& material);
[[nodiscard]] Command addMaterialImport(CLI::App& material);
[[nodiscard]] Command addMaterialExport(CLI::App& material);

} // namespace celadon::app
