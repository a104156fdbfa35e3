#pragma once

#include "ui/command.h"
#include "ui/session.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

/// What was done to materials since they were opened, on disk as it happens: after a crash a replay
/// brings it back, but for a stroke that was under way. One file a session, gone when the session
/// ends well.
namespace celadon::ui {

class Journal {
public:
    /// Nothing is written before the first change. @param folder made when it is needed
    explicit Journal(std::filesystem::path folder);
    ~Journal(); ///< the file stays: only finish() removes it
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Another scene: earlier entries are of no use.
    void begin(const OpenRequest& opened);
    /// Keeps it if it changes a material. Failures to write are said once.
    /// @return what went wrong, the first time
    [[nodiscard]] std::optional<std::string> add(const Command& command);
    /// Nothing is left to recover.
    void finish();

private:
    std::filesystem::path mFolder;
    std::filesystem::path mFile;
    std::ofstream mStream;
    OpenRequest mOpened;
    bool mHasFailed = false;
};

/// A session that did not end well.
struct Recovery {
    std::filesystem::path file;
    OpenRequest opened;
    std::vector<Command> commands;
};

/// The latest journal of a process that is no more; broken ones are passed over.
[[nodiscard]] std::optional<Recovery> findRecovery(const std::filesystem::path& folder);
/// Whether a command is kept in a journal.
[[nodiscard]] bool changesMaterial(const Command& command);

} // namespace celadon::ui
