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
    int selected = -1;        ///< deformer of the list; -1: none
    int control = -1;         ///< its control point (Lattice::index) or handle; -1: none
    bool isAddingHandles = false; ///< clicks on the surface add handles
};

} // namespace celadon::ui
