#pragma once

#include "ui/command.h"
#include "ui/session.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

/// What was done to materials and deformers since they were opened, on disk as it happens: after a
/// crash a replay brings it back, but for a stroke that was under way. One file a session, gone
/// when it ends well.
///
/// A replay starts from the materials as they were opened, whoever names them. A file that the
/// session replaces is kept beside the journal, so that steps, and undoing them, go on meaning the
/// same after a save.
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
    /// Keeps it if it changes a material or the deformers. Failures to write are said once.
    /// @return what went wrong, the first time
    [[nodiscard]] std::optional<std::string> add(const Command& command);
    /// To be called before a file is written: keeps what stands there, if any change is in the
    /// journal. @return what went wrong
    [[nodiscard]] std::optional<std::string> keep(const std::filesystem::path& file);
    /// Why the session ends before its time, for who recovers it; nothing where there is nothing to
    /// recover.
    void explain(const std::string& reason);
    /// Nothing is left to recover.
    void finish();

private:
    void write(const Command& command);

    std::filesystem::path mFolder;
    std::filesystem::path mFile;
    std::ofstream mStream;
    OpenRequest mOpened; ///< with all that was kept
    bool mHasFailed = false;
};

/// A session that did not end well.
struct Recovery {
    std::filesystem::path file;
    OpenRequest opened;
    std::vector<Command> commands;
    std::string reason{}; ///< why it ended; empty: it could not say

    /// As who did them counts: a drag is one, however many commands it is.
    [[nodiscard]] std::size_t steps() const;
};
/// Whether a command goes on with what the one before it did.
[[nodiscard]] bool continuesStep(const Command& command);

/// The latest journal of a process that is no more; broken ones are passed over.
[[nodiscard]] std::optional<Recovery> findRecovery(const std::filesystem::path& folder);
/// Removes a journal and what was kept beside it.
void discard(const Recovery& recovery);
/// Whether a command is kept in a journal: it changes a material, the deformers or the size.
[[nodiscard]] bool changesWork(const Command& command);

} // namespace celadon::ui
