#pragma once

#include "ui/input_event.h"
#include "ui/pen_track.h"

#include <map>
#include <memory>
#include <optional>
#include <span>

struct GLFWwindow;
struct xcb_connection_t;
struct xcb_input_button_press_event_t;

/// Pressure of pens, which GLFW 3.3 does not tell: asked of the X server (XInput 2.0) on a
/// connection of its own. Main thread.
namespace celadon::ui {

class PenInput {
public:
    /// Without an X server, or with one that knows no XInput, there are no pens.
    explicit PenInput(GLFWwindow* window);
    ~PenInput();
    PenInput(const PenInput&) = delete;
    PenInput& operator=(const PenInput&) = delete;

    /// Some device that has pressure is connected.
    [[nodiscard]] bool hasPen() const { return !mPens.empty(); }

    /// Gives events that GLFW has just told of the pressure with which they were made.
    void tell(std::span<InputEvent> events);

private:
    /// A device and the axis that is its pressure.
    struct Pen {
        unsigned axis = 0;
        double least = 0.0, most = 1.0;
        bool isEraser = false;
        float pressure = 0.0f; ///< the latest, in [0, 1]

        void follow(const xcb_input_button_press_event_t* motion);
    };
    struct Disconnect {
        void operator()(xcb_connection_t* connection) const;
    };

    bool connect();
    void findPens();
    void place(glm::dvec2 positionPx);
    /// @param answer      number of the question whose answer has come
    /// @param cursorThen  what it says
    void readEvents(unsigned answer, glm::dvec2 cursorThen);

    std::unique_ptr<xcb_connection_t, Disconnect> mConnection;
    unsigned mWindow = 0;
    unsigned mExtension = 0;      ///< the major opcode of XInput
    std::map<int, Pen> mPens;     ///< by the number of the device
    std::optional<Pen> mUnplaced; ///< as it last was, at a place that is not known yet
    PenTrack mTrack;
};

} // namespace celadon::ui
