#pragma once

#include <span>
#include <string>
#include <string_view>

/// Which keys do what: one table for the keyboard, the menus and the help.
namespace celadon::ui {

enum class Action {
    Help,
    Panels,
    FullScreen,
    Save,
    SaveAs,
    Open,
    Quit,
    Undo,
    Redo,
    Swap,
    Pick,
    Radius,
    Strength,
    Smaller,
    Larger,
    Frame,
    Front,
    Right,
    Top,
    Back,
    Left,
    Bottom,
    Initial,
    Projection,
    TurnLeft,
    TurnRight,
    TurnUp,
    TurnDown,
    Cancel,
    SelectAll,
    SelectNone,
    SelectInvert,
    Select,
    Paint,
    Play,
    Turntable,
    StepBack,
    StepOn,
    Key
};

struct Shortcut {
    Action action;
    int key = 0;       ///< GLFW's
    int modifiers = 0; ///< GLFW's: exactly these of control, shift and alt
    const char* keys;  ///< as shown
    const char* group;
    const char* help; ///< null: a second way, not listed
};

[[nodiscard]] std::span<const Shortcut> shortcuts();
/// Null when a key does nothing.
[[nodiscard]] const Shortcut* findShortcut(int key, int modifiers);
/// What the mouse does, for the help: keys and meaning.
struct MouseHelp {
    const char* keys;
    const char* help;
};
[[nodiscard]] std::span<const MouseHelp> mouseHelp();

} // namespace celadon::ui
