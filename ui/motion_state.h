#pragma once

#include "renderer/scene/animated_deformer.h"

#include <cstddef>
#include <optional>

namespace celadon::ui {

/// What moves the model, and when: everything that its shape depends on.
struct MotionSetting {
    DeformerStack deformers;
    std::optional<std::size_t> animation; ///< of the model; none: its rest pose
    double seconds = 0.0;
    bool operator==(const MotionSetting&) const = default;
};

/// The setting, and what the Deform panel and the viewport do with it.
struct MotionState {
    MotionSetting now;
    bool isPlaying = false;
    double speed = 1.0;           ///< seconds of the motion per second of the clock
    bool loops = true;            ///< else it stops at the end
    int selected = -1;            ///< deformer of the list; -1: none
    int control = -1;             ///< its control point (Lattice::index) or handle; -1: none
    bool isAddingHandles = false; ///< clicks on the surface add handles
    bool areControlsShown = true; ///< control points and handles are seen and can be dragged
};

} // namespace celadon::ui
