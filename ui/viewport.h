#pragma once

#include "renderer/gl/texture.h"
#include "ui/camera_controller.h"
#include "ui/picture_worker.h"
#include "ui/session.h"

#include <glm/vec2.hpp>

#include <chrono>
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

    /// The picture on screen: RGB, rows from the top.
    [[nodiscard]] std::vector<unsigned char> readPixels() const;

    /// Refining stops here.
    void setFinestRung(int rung) { mFinestRung = rung; }
    [[nodiscard]] bool isSettled(const Session& session) const;
    [[nodiscard]] const QualityLadder& ladder() const { return mLadder; }
    [[nodiscard]] int shownRung() const { return mShownRevision != 0 ? mShown.rungIndex : -1; }
    [[nodiscard]] const Picture& shown() const { return mShown; } ///< without pixels
    [[nodiscard]] std::uint64_t pictureCount() const { return mPictureCount; }
    [[nodiscard]] bool isWaiting() const { return mInFlight.has_value(); }

private:
    using Clock = std::chrono::steady_clock;
    struct InFlight {
        std::uint64_t revision = 0;
        int rung = 0;
        glm::ivec2 sizePx{0};
    };

    bool takePicture(Session& session);
    void passMaterials(Session& session);
    void ask(Session& session, int rung);

    PictureWorker& mWorker;
    QualityLadder mLadder;
    ViewportRect mRect;
    gl::Texture mTexture;
    Picture mShown;
    std::uint64_t mShownRevision = 0;
    std::uint64_t mPictureCount = 0;
    bool mHasSelection = false; ///< part of a material is selected: it is shown
    std::uint64_t mWorldRevision = 0;
    std::uint64_t mSeenRevision = 0;
    std::optional<InFlight> mInFlight;
    Clock::time_point mLastChange;
    int mFinestRung;
};

/// Colors behind the object: linear, top and bottom.
[[nodiscard]] WindowDisplay windowDisplay(const ViewState& view);

} // namespace celadon::ui
