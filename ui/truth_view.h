#pragma once

#include "renderer/explain/frame_difference.h"
#include "renderer/gl/texture.h"
#include "ui/background_jobs.h"
#include "ui/session.h"

#include <cstdint>
#include <optional>

struct ImDrawList;

/// The view "Difference to truth": worked out in the background once the hand rests, coarse first;
/// given up when something changes.
namespace celadon::ui {

struct ViewportRect;

class TruthView {
public:
    explicit TruthView(BackgroundJobs& jobs) : mJobs(jobs) {}

    /// Starts and cancels the work. @param isAtRest the picture on screen is current
    void update(const Session& session, glm::ivec2 viewportPx, bool isAtRest);

    /// Of the session as it is; null while there is none. Without pixels.
    [[nodiscard]] const FrameDifference* difference(const Session& session) const;
    [[nodiscard]] bool isComplete(const Session& session) const {
        return difference(session) != nullptr && mIsComplete;
    }
    /// Of the session as it is: what is there stays, no more comes until something changes.
    void giveUp();
    [[nodiscard]] bool isGivenUp() const { return mIsGivenUp; }
    /// The heat map over the viewport, if there is one.
    void draw(const Session& session, ImDrawList& list, const ViewportRect& rect) const;

private:
    void start(const Session& session, glm::ivec2 viewportPx);

    BackgroundJobs& mJobs;
    std::uint64_t mAskedRevision = 0; ///< of the work under way or done; 0: none
    std::uint64_t mShownRevision = 0;
    bool mIsComplete = false;
    bool mIsGivenUp = false;
    FrameDifference mDifference;
    gl::Texture mTexture;
};

} // namespace celadon::ui
