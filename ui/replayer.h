#pragma once

#include "ui/command.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

/// A replay in a window: commands one after another, with pauses for screenshots. No window here.
namespace celadon::ui {

class Replayer {
public:
    /// @param screenshotsAt after which command (from 1; 0: before the first) a picture is wanted
    Replayer(std::vector<Command> commands,
             std::vector<std::pair<int, std::filesystem::path>> screenshotsAt);

    /// The screenshot that is due now; the replay waits until screenshotTaken().
    [[nodiscard]] std::optional<std::filesystem::path> dueScreenshot() const;
    void screenshotTaken();
    /// The next command, unless a screenshot is due or the end is reached.
    [[nodiscard]] std::optional<Command> next();
    [[nodiscard]] bool isDone() const;
    /// From the first command again; screenshots were taken.
    void begin() { mNext = 0; }
    [[nodiscard]] std::size_t executed() const { return mNext; }

private:
    std::vector<Command> mCommands;
    std::vector<std::pair<int, std::filesystem::path>> mScreenshots; ///< by number
    std::size_t mNext = 0;
    std::size_t mTaken = 0;
};

} // namespace celadon::ui
