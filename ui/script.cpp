#include "ui/script.h"

#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <fstream>
#include <string>
#include <utility>

namespace celadon::ui {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Resident memory of this process in MB (proc(5), status); 0 where the system does not tell.
double residentMb() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) {
            return std::stod(line.substr(6)) / 1024.0;
        }
    }
    return 0.0;
}

} // namespace

Script::Script(const EditorOptions& options, Session& session)
    : mOptions(options), mSession(session), mLastScreenshot(options.screenshot) {
    if (options.record) {
        mRecorder.emplace(*options.record);
        session.dispatcher().observe([this](const Command& command) {
            try {
                mRecorder->write(command);
            } catch (const OutputError& error) { // the work goes on
                mSession.notify(Notice::Kind::Error, error.what());
            }
        });
    }
    if (options.replay || !options.screenshotsAt.empty()) {
        mReplayer.emplace(options.replay ? readCommands(*options.replay) : std::vector<Command>(),
                          options.screenshotsAt);
    }
}

bool Script::mustRepeat() const {
    return mReplayer && 1e3 * mOptions.repeatSeconds > millisecondsSince(mStart);
}

bool Script::isReady(const Progress& progress) const {
    if (!mReplayer && !mLastScreenshot && !mOptions.exitAfterReplay) {
        return false;
    }
    if (mIsTracing) {
        return progress.shownRevision >= mAwaitedRevision;
    }
    if (isReplaying()) {
        return !mReplayer->dueScreenshot() || progress.isQuiet;
    }
    return mustRepeat() ||
           (mLastScreenshot ? progress.isQuiet : mOptions.exitAfterReplay && !progress.isBusy);
}

Script::Step Script::advance(const Progress& progress) {
    Step step;
    if (!isReady(progress)) {
        return step;
    }
    if (mIsTracing) {
        mIsTracing = false;
        const auto processor = static_cast<double>(std::clock() - mProcessorBegin);
        mOptions.trace({1e-3 * millisecondsSince(mStart), mCommandMs,
                        millisecondsSince(mCommandBegin) - mCommandMs,
                        1e3 * processor / CLOCKS_PER_SEC, residentMb()});
    } else if (isReplaying()) {
        if (const auto file = mReplayer->dueScreenshot()) {
            step.screenshot = file;
            mReplayer->screenshotTaken();
        } else if (const std::optional<Command> command = mReplayer->next()) {
            const std::uint64_t before = mSession.pictureRevision();
            mCommandBegin = Clock::now();
            mProcessorBegin = std::clock();
            mSession.execute(*command);
            mCommandMs = millisecondsSince(mCommandBegin);
            step.isCommand = true;
            mAwaitedRevision = mSession.pictureRevision();
            mIsTracing = mOptions.trace && mAwaitedRevision != before;
        }
    } else if (mustRepeat()) {
        mReplayer->begin();
    } else if (mLastScreenshot) {
        step.screenshot = std::exchange(mLastScreenshot, std::nullopt);
    } else {
        step.isOver = true;
    }
    return step;
}

void Script::writeState(const nlohmann::json& state) {
    const std::string text = state.dump() + "\n";
    if (text != mWrittenState) {
        writeFileAtomically(*mOptions.state, text);
        mWrittenState = text;
    }
}

} // namespace celadon::ui
