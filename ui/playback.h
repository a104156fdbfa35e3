#pragma once

#include "ui/layout_state.h"

#include <chrono>

/// Motion and turntable go on with the clock, as fast as pictures come.
namespace celadon::ui {

class Playback {
public:
    Playback(Session& session, const Viewport& viewport, LayoutState& layout)
        : mSession(session), mViewport(viewport), mLayout(layout) {}

    [[nodiscard]] bool isOn() const { return mLayout.isTurning || mSession.motion.isPlaying; }
    /// @param isInputWaiting  for the shape of this moment: it must not go on
    /// @return whether anything went on
    bool advance(bool isInputWaiting);
    /// Plays, or stops at the moment that is shown; where nothing changes over time, the turntable.
    void toggle();
    void toggleTurntable() { mLayout.isTurning = !mLayout.isTurning; }

private:
    Session& mSession;
    const Viewport& mViewport;
    LayoutState& mLayout;
    std::chrono::steady_clock::time_point mPlayedUntil; ///< what turns or plays has come so far
};

} // namespace celadon::ui
