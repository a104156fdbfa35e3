#include "ui/playback.h"

namespace celadon::ui {

namespace {

constexpr double kTurnDegreesPerSecond = 36.0;

} // namespace

bool Playback::advance(bool isInputWaiting) {
    const auto now = std::chrono::steady_clock::now();
    if (!isOn() || isInputWaiting || !mSession.hasWorld()) {
        mPlayedUntil = now;
        return false;
    }
    if (mViewport.isWaiting()) {
        return false; // no moment is skipped for one that would never be shown
    }
    const double seconds = std::chrono::duration<double>(now - mPlayedUntil).count();
    mPlayedUntil = now;
    if (mLayout.isTurning) {
        mSession.perform({"camera.turntable", {{"degrees", kTurnDegreesPerSecond * seconds}}});
    }
    if (mSession.motion.isPlaying && !mSession.advanceTime(seconds)) {
        toggle();
    }
    return true;
}

void Playback::toggle() {
    const MotionState& motion = mSession.motion;
    const double duration = mSession.hasWorld() ? mSession.mover().durationSeconds() : 0.0;
    if (motion.isPlaying || duration > 0.0) {
        const bool isOver = !motion.isPlaying && !motion.loops && motion.now.seconds >= duration;
        mSession.perform(
            {"motion.play",
             {{"on", !motion.isPlaying}, {"seconds", isOver ? 0.0 : motion.now.seconds}}});
    } else {
        toggleTurntable();
    }
}

} // namespace celadon::ui
