#pragma once

#include <CLI/App.hpp>

namespace celadon {

/// `celadon profile make|table`: scattering profiles and the tables computed from them.
/// The command runs in the parser's callback; failures are celadon::Error.
void addProfileCommand(CLI::App& app);

} // namespace celadon
