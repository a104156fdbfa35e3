#include "ui/replayer.h"

#include <algorithm>

namespace celadon::ui {

Replayer::Replayer(std::vector<Command> commands,
                   std::vector<std::pair<int, std::filesystem::path>> screenshotsAt)
    : mCommands(std::move(commands)), mScreenshots(std::move(screenshotsAt)) {
    std::stable_sort(mScreenshots.begin(), mScreenshots.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
}

std::optional<std::filesystem::path> Replayer::dueScreenshot() const {
    if (mTaken < mScreenshots.size() &&
        (mScreenshots[mTaken].first <= static_cast<int>(mNext) || mNext == mCommands.size())) {
        return mScreenshots[mTaken].second;
    }
    return std::nullopt;
}

void Replayer::screenshotTaken() {
    ++mTaken;
}

std::optional<Command> Replayer::next() {
    if (dueScreenshot() || mNext == mCommands.size()) {
        return std::nullopt;
    }
    return mCommands[mNext++];
}

bool Replayer::isDone() const {
    return mNext == mCommands.size() && mTaken == mScreenshots.size();
}

} // namespace celadon::ui
