#pragma once

#include "ui/input_event.h"

#include <deque>
#include <optional>

/// What pens report, and which events of the cursor it belongs to. The two come by different ways:
/// they are matched by the places that they name, in their order.
namespace celadon::ui {

struct PenPoint {
    glm::dvec2 positionPx{0.0}; ///< as InputEvent has it, but with fractions
    float pressure = 0.0f;      ///< in [0, 1]
    bool isEraser = false;
};

class PenTrack {
public:
    void add(const PenPoint& point);

    /// Gives an event what the pen reported there, and forgets all that came before. An event at a
    /// place where no pen was is a mouse's.
    void match(InputEvent& event);

private:
    std::deque<PenPoint> mAhead;  ///< not matched yet
    std::optional<PenPoint> mNow; ///< where the cursor is, if a pen brought it there
};

} // namespace celadon::ui
