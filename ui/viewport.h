#pragma once

#include "renderer/gl/texture.h"
#include "ui/camera_controller.h"
#include "ui/picture_worker.h"
#include "ui/session.h"

#include <glm/vec2.hpp>

#include <chrono>
#include <deque>
#include <optional>

struct ImDrawList;

/// The picture of the session in the window: asks the worker for coarse ones while something
/// changes, for finer ones at rest, and shows the latest.
namespace celadon::ui {

/// Where the viewport is, window pixels from the top left.
struct ViewportRect {
    glm::ivec2 origin{0};
    glm::ivec2 size{1};

    [[nodiscard]] double aspect() const { return static_cast<double>(size.x) / size.y; }
    [[nodiscard]] bool contains(glm::dvec2 point) const;
    /// (0,0) top left, (1,1) bottom right.
    [[nodiscard]] glm::dvec2 place(glm::dvec2 point) const;
};

class Viewport {
public:
    /// @param budgetMs what a picture may take while something moves
    Viewport(PictureWorker& worker, double budgetMs);

    void setRect(const ViewportRect& rect) { mRect = rect; }
    [[nodiscard]] const ViewportRect& rect() const { return mRect; }

    /// Takes a finished picture and asks for the next. @return whether the window must be redrawn
    bool update(Session& session);
    /// Seconds until update() has something to do by itself; < 0: nothing.
    [[nodiscard]] double secondsToNextStep() const;
    void draw(ImDrawList& list) const;
    /// The picture on screen: RGBA8, rows from the bottom.
    [[nodiscard]] const gl::Texture& texture() const { return mTexture; }

    /// Refining stops here.
    void setFinestRung(int rung) { mFinestRung = rung; }
    [[nodiscard]] bool isSettled(const Session& session) const;
    /// Nothing moves, and the picture on screen shows the session as it is.
    [[nodiscard]] bool isAtRest(const Session& session) const;
    /// At rest, pictures as a moving hand will need them are rendered and not shown, until their
    /// times are known: the first stroke is not the one that waits for compilers.
    void rehearse(bool on) { mRehearses = on; }
    /// Pictures at rest count samples and pairs.
    void wantCounts(bool on) { mWantsCounts = on; }
    [[nodiscard]] const QualityLadder& ladder() const { return mLadder; }
    [[nodiscard]] int shownRung() const { return mShownRevision != 0 ? mShown.rungIndex : -1; }
    [[nodiscard]] const Picture& shown() const { return mShown; } ///< without pixels
    [[nodiscard]] std::uint64_t pictureCount() const { return mPictureCount; }
    [[nodiscard]] std::uint64_t shownRevision() const { return mShownRevision; }
    /// The latest pictures, oldest first: how long each took.
    struct Timing {
        StageMilliseconds stages;
        double totalMs = 0.0;
    };
    [[nodiscard]] const std::deque<Timing>& timings() const { return mTimings; }
    /// The first picture of what was opened is long in coming: draw() says so.
    [[nodiscard]] bool isPreparing() const { return mIsPreparing; }
    /// How much of the tables that pictures wait for is made, 0 to 1; nothing while none are.
    [[nodiscard]] std::optional<float> tablesMade() const { return mWorker.tablesMade(); }
    [[nodiscard]] bool isWaiting() const {
        return mInFlight && mInFlight->purpose != Purpose::Rehearsal;
    }

private:
    using Clock = std::chrono::steady_clock;
    enum class Purpose {
        Change,     ///< shows what has changed: finished and shown, however long it takes
        Refinement, ///< of what is on screen already: given up when something moves
        Rehearsal   ///< not shown: compiles and measures what a moving hand will need
    };
    struct InFlight {
        std::uint64_t revision = 0;
        int rung = 0;
        glm::ivec2 sizePx{0};
        Purpose purpose = Purpose::Change;
    };

    bool takePicture(Session& session);
    void learn(const Picture& picture);
    void passMaterials(Session& session);
    void ask(Session& session, int rung, Purpose purpose);

    PictureWorker& mWorker;
    QualityLadder mLadder;
    ViewportRect mRect;
    gl::Texture mTexture;
    Picture mShown;
    std::uint64_t mShownRevision = 0;
    std::uint64_t mPictureCount = 0;
    std::deque<Timing> mTimings;
    bool mWantsCounts = false;
    bool mRehearses = false;
    std::vector<bool> mKnown; ///< per rung: its time is known at this size
    glm::ivec2 mKnownSize{0};
    bool mHasSelection = false; ///< part of a material is selected: it is shown
    std::uint64_t mWorldRevision = 0;
    Clock::time_point mWorldSince;
    std::string mPreparing; ///< what takes the time
    bool mIsPreparing = false;
    std::uint64_t mSeenRevision = 0;
    int mFailures = 0; ///< of pictures of that revision
    std::optional<InFlight> mInFlight;
    Clock::time_point mLastChange;
    int mFinestRung;
};

/// A picture, rows from the bottom, over the whole viewport.
void drawOver(const gl::Texture& texture, const ViewportRect& rect, ImDrawList& list);

/// Colors behind the object: linear, top and bottom.
[[nodiscard]] WindowDisplay windowDisplay(const ViewState& view);

} // namespace celadon::ui
