#include "app/progress.h"

#include <fmt/format.h>

#include <cmath>
#include <unistd.h>
#include <utility>

namespace celadon::app {
namespace {
constexpr auto kRedrawInterval = std::chrono::milliseconds(150);
constexpr const char* kWipeLine = "\r\x1b[K";
} // namespace

std::string progressText(const std::string& task, std::size_t done, std::size_t total,
                         double elapsedSeconds) {
    if (total == 0) {
        return fmt::format("{} {}", task, done);
    }
    std::string text = fmt::format("{} {}/{}", task, done, total);
    if (done > 0 && done < total) {
        const double left =
            elapsedSeconds / static_cast<double>(done) * static_cast<double>(total - done);
        if (left >= 60.0) {
            text += fmt::format(", {:.0f} min left", std::ceil(left / 60.0));
        } else if (left >= 1.0) {
            text += fmt::format(", {:.0f} s left", left);
        }
    }
    return text;
}

Progress::Progress(std::string task, std::size_t total)
    : Progress(std::move(task), total, stderr, ::isatty(STDERR_FILENO) != 0) {}

Progress::Progress(std::string task, std::size_t total, std::FILE* stream, bool isTerminal)
    : mTask(std::move(task)), mTotal(total), mStream(stream), mIsTerminal(isTerminal) {}

Progress::~Progress() {
    if (mDrawn) {
        std::fputs(kWipeLine, mStream);
        std::fflush(mStream);
    }
}

void Progress::update(std::size_t done) {
    const Clock::time_point now = Clock::now();
    if (!mIsTerminal || (mDrawn && now - mLastDraw < kRedrawInterval)) {
        return;
    }
    const double elapsed = std::chrono::duration<double>(now - mStart).count();
    fmt::print(mStream, "{}{}", kWipeLine, progressText(mTask, done, mTotal, elapsed));
    std::fflush(mStream);
    mDrawn = true;
    mLastDraw = now;
}

} // namespace celadon::app
