#pragma once

#include "ui/command.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// Commands as a file, one line of JSON each; lines that are empty or begin with # are skipped.
namespace celadon::ui {

/// Writes each command as it happens, so that a crash loses none.
class Recorder {
public:
    /// @throws OutputError
    explicit Recorder(const std::filesystem::path& file);
    /// @throws OutputError the first time that it fails; what follows is not written
    void write(const Command& command);

private:
    std::filesystem::path mFile;
    std::ofstream mStream;
    bool mHasFailed = false;
};

enum class Tail { IsWhole, MayBeCut };

/// @param tail MayBeCut: a last line that cannot be read is left out
/// @throws InputError naming file and line
[[nodiscard]] std::vector<Command> readCommands(const std::filesystem::path& file,
                                                Tail tail = Tail::IsWhole);

} // namespace celadon::ui
