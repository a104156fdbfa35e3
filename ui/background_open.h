#pragma once

#include "ui/session.h"

#include <chrono>
#include <future>
#include <optional>
#include <string>

/// Reads a model on a thread of its own: parsing and an atlas may take seconds, and the window goes
/// on.
namespace celadon::ui {

class BackgroundOpen {
public:
    explicit BackgroundOpen(Session& session) : mSession(session) {}

    /// Replaces what is being read.
    void start(const OpenRequest& request);
    /// The result is thrown away when it comes.
    void cancel() { mIsWanted = false; }
    [[nodiscard]] bool isRunning() const { return mFuture.valid() && mIsWanted; }
    [[nodiscard]] const OpenRequest& request() const { return mRequest; }
    [[nodiscard]] double seconds() const;
    /// Adopts a scene that is ready; failures become notices. @return whether something changed
    bool poll();

private:
    Session& mSession;
    OpenRequest mRequest;
    std::optional<OpenRequest> mNext; ///< asked for while another was being read
    std::future<OpenedScene> mFuture;
    bool mIsWanted = false;
    std::chrono::steady_clock::time_point mStart;
};

} // namespace celadon::ui
