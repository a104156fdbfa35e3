#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

/// One line that tells how far long work has come, on a terminal only; elsewhere silent.
namespace celadon::app {

class Progress {
public:
    /// @param task  what is done: "frames"
    /// @param total steps, 0 where unknown
    Progress(std::string task, std::size_t total);
    /// For tests: any stream, taken for a terminal or not.
    Progress(std::string task, std::size_t total, std::FILE* stream, bool isTerminal);
    ~Progress(); ///< wipes the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Redraws a few times a second at most, so it may be called often.
    void update(std::size_t done);

private:
    using Clock = std::chrono::steady_clock;

    std::string mTask;
    std::size_t mTotal;
    std::FILE* mStream;
    bool mIsTerminal;
    bool mDrawn = false;
    Clock::time_point mStart = Clock::now();
    Clock::time_point mLastDraw;
};

/// "frames 3/10, 12 s left": the text of the line. Remaining time is left out before it can be
/// known and when it is under a second.
[[nodiscard]] std::string progressText(const std::string& task, std::size_t done, std::size_t total,
                                       double elapsedSeconds);

} // namespace celadon::app
