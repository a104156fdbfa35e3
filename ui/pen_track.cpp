#include "ui/pen_track.h"

#include <glm/common.hpp>

#include <algorithm>

namespace celadon::ui {

namespace {

/// Reports that nobody asks about, as while the cursor is hidden, are not kept for ever.
constexpr std::size_t kMostPoints = 4096;

bool isAt(const PenPoint& point, glm::dvec2 positionPx) {
    return glm::floor(point.positionPx) == glm::floor(positionPx);
}

} // namespace

void PenTrack::add(const PenPoint& point) {
    mAhead.push_back(point);
    if (mAhead.size() > kMostPoints) {
        mAhead.pop_front();
    }
}

void PenTrack::match(InputEvent& event) {
    if (event.kind == InputEvent::Kind::Key || event.kind == InputEvent::Kind::Wheel) {
        return;
    }
    const auto found = std::ranges::find_if(
        mAhead, [&](const PenPoint& point) { return isAt(point, event.positionPx); });
    if (found != mAhead.end()) {
        // A cursor that stays where it is sends no event when the pressure changes.
        const auto end = std::find_if_not(found, mAhead.end(), [&](const PenPoint& point) {
            return isAt(point, event.positionPx);
        });
        mNow = *(end - 1);
        mAhead.erase(mAhead.begin(), end);
    } else if (mNow && !isAt(*mNow, event.positionPx)) {
        mNow.reset();
    }
    if (!mNow) {
        return;
    }
    event.isEraser = mNow->isEraser;
    // A pen presses with more than nothing: without, it hovers where a mouse clicks.
    if (mNow->pressure > 0.0f || event.kind != InputEvent::Kind::Press) {
        event.pressure = mNow->pressure;
    }
}

} // namespace celadon::ui
