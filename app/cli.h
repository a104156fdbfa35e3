#pragma once

/// The command line: which command, its options, help, and mistakes (DESIGN section 5).
namespace celadon::app {

/// Parses and runs. Help and version go to stdout.
/// @return the exit code, 0
/// @throws celadon::Error, UsageError for a command line that cannot be understood
int runCommandLine(int argc, const char* const* argv);

} // namespace celadon::app
