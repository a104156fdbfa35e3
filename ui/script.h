#pragma once

#include "ui/editor_options.h"
#include "ui/recorder.h"
#include "ui/replayer.h"
#include "ui/session.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

/// What scripts make of the editor: recording, replaying, screenshots, a trace of times and memory,
/// the state file.
namespace celadon::ui {

class Script {
public:
    /// @throws InputError for a replay that cannot be read, OutputError for a record
    Script(const EditorOptions& options, Session& session);

    /// Nobody sits in front of the window.
    [[nodiscard]] bool isUnattended() const { return mOptions.replay || mOptions.exitAfterReplay; }
    /// What the replay may have to wait for.
    struct Progress {
        bool isQuiet = false;            ///< the picture on screen is final
        bool isBusy = false;             ///< a job is under way in the background
        std::uint64_t shownRevision = 0; ///< of the session, that the picture on screen shows
    };
    /// advance() would do something.
    [[nodiscard]] bool isReady(const Progress& progress) const;

    struct Step {
        std::optional<std::filesystem::path> screenshot; ///< to be taken now
        bool isCommand = false;                          ///< one was executed
        bool isOver = false;                             ///< the window closes
    };
    /// The next command, or a screenshot that is due.
    /// @throws celadon::Error for a command that fails
    Step advance(const Progress& progress);

    [[nodiscard]] std::size_t executed() const { return mReplayer ? mReplayer->executed() : 0; }
    /// Writes the state file, which was asked for, where it changed.
    void writeState(const nlohmann::json& state);

private:
    [[nodiscard]] bool isReplaying() const { return mReplayer && !mReplayer->isDone(); }
    [[nodiscard]] bool mustRepeat() const;
    const EditorOptions& mOptions;
    Session& mSession;
    std::optional<Recorder> mRecorder;
    std::optional<Replayer> mReplayer;
    std::optional<std::filesystem::path> mLastScreenshot; ///< --screenshot, still to be taken
    std::string mWrittenState;
    std::chrono::steady_clock::time_point mStart = std::chrono::steady_clock::now();
    bool mIsTracing = false; ///< a command waits for its picture
    std::uint64_t mAwaitedRevision = 0;
    std::chrono::steady_clock::time_point mCommandBegin;
    double mCommandMs = 0.0;
    std::clock_t mProcessorBegin = 0;
};

} // namespace celadon::ui
