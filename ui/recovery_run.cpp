#include "ui/recovery_run.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

namespace celadon::ui {

void RecoveryRun::await(Recovery recovery) {
    mAwaited = std::move(recovery);
}

void RecoveryRun::sceneOpened() {
    if (mAwaited && mAwaited->opened == mSession.opened()) {
        mRunning = std::exchange(mAwaited, std::nullopt);
        mDone = mSteps = mGoodSteps = 0;
        mSession.setHistoryBytes(std::numeric_limits<std::size_t>::max()); // as much as was undone
    }
}

std::string RecoveryRun::activity() const {
    return mRunning ? fmt::format("Recovering, step {} of {}", mSteps, mRunning->steps())
                    : std::string();
}

bool RecoveryRun::advance(bool keepsJournal) {
    using Clock = std::chrono::steady_clock;
    constexpr auto kAtOnce = std::chrono::milliseconds(80);
    const auto begin = Clock::now();
    const std::vector<Command>& commands = mRunning->commands;
    while (mDone < commands.size() && Clock::now() - begin < kAtOnce) {
        const Command& command = commands[mDone++];
        const bool isNew = !continuesStep(command);
        mSteps += isNew ? 1 : 0;
        mGoodSteps += mSession.performNow(command) && isNew ? 1 : 0;
    }
    if (mDone < commands.size()) {
        return false;
    }
    finish(keepsJournal);
    return true;
}

void RecoveryRun::finish(bool keepsJournal) {
    const Recovery recovered = std::move(*std::exchange(mRunning, std::nullopt));
    if (keepsJournal) {
        for (const Command& command : recovered.commands) {
            if (const auto problem = mJournal.add(command)) {
                mSession.notify(Notice::Kind::Warning, *problem);
            }
        }
    }
    std::error_code ignored;
    std::filesystem::remove(recovered.file, ignored);
    mSession.forgetMaterialFiles(); // nothing takes a file's name unless asked to
    mSession.notify(Notice::Kind::Info,
                    fmt::format("Recovered {} of {} steps; they are not saved yet", mGoodSteps,
                                recovered.steps()));
}

} // namespace celadon::ui
