#pragma once

#include <CLI/App.hpp>

namespace celadon {

/// `celadon material bake|info`: SubEdit materials without the editor.
/// The command runs in the parser's callback; failures are celadon::Error.
void addMaterialCommand(CLI::App& app);

} // namespace celadon
