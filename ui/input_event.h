#pragma once

#include <glm/vec2.hpp>

namespace celadon::ui {

/// What hands did to the window since the last frame, in order: nothing is lost between frames.
struct InputEvent {
    enum class Kind { Move, Press, Release, Wheel, Key };
    Kind kind = Kind::Move;
    glm::dvec2 positionPx{0.0}; ///< of the cursor, window pixels from the top left
    int button = 0;             ///< GLFW's mouse button or key
    int modifiers = 0;          ///< GLFW's
    bool isRepeated = false;    ///< a key that is held down
    double wheel = 0.0;
    float pressure = 1.0f; ///< of the pen that did it, in [0, 1]; 1 of a mouse
    bool isEraser = false; ///< by the other end of a pen
};

} // namespace celadon::ui
