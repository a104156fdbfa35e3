#pragma once

#include "ui/session.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <utility>

/// Saving a material: at once, as a command does it, or on a thread of its own from a copy, so that
/// the hand goes on while a large map is compressed.
namespace celadon::ui {

/// What is to be written where.
struct MaterialSave {
    int material = 0;
    std::filesystem::path file;
    std::string name; ///< of the material from now on; empty: as it is
};

/// The command that does it.
[[nodiscard]] Command saveCommand(const MaterialSave& save);

/// @throws UsageError: no such material, no name of a material file, a stroke is under way;
/// OutputError
void saveMaterial(Session& session, const MaterialSave& save);

class BackgroundSave {
public:
    /// @param wake called on the thread of its own when poll() has something to do
    BackgroundSave(Session& session, std::function<void()> wake)
        : mSession(session), mWake(std::move(wake)) {}

    /// One after the other: waits for the one before. Failures become notices.
    /// @param then once it is written
    void start(const MaterialSave& save, std::function<void()> then);
    [[nodiscard]] bool isRunning() const { return mFuture.valid(); }
    /// Until all is written.
    void wait();
    [[nodiscard]] const std::filesystem::path& file() const { return mSave.file; }
    [[nodiscard]] double seconds() const;
    /// Takes note of what is written. @return whether something changed
    bool poll();

private:
    void finish();

    Session& mSession;
    std::function<void()> mWake;
    MaterialSave mSave;
    std::uint64_t mContent = 0; ///< Document::contentId() of the copy
    std::uint64_t mWorld = 0;   ///< to which it belongs
    std::function<void()> mThen;
    std::future<void> mFuture;
    std::chrono::steady_clock::time_point mStart;
};

} // namespace celadon::ui
