#include "ui/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

namespace celadon::ui {

namespace {

constexpr int kControl = GLFW_MOD_CONTROL;
constexpr int kShift = GLFW_MOD_SHIFT;

constexpr Shortcut kShortcuts[] = {
    {Action::Radius, GLFW_KEY_F, 0, "F", "Paint", "Brush radius: move the mouse, click"},
    {Action::Strength, GLFW_KEY_F, kShift, "Shift+F", "Paint", "Flow: move the mouse, click"},
    {Action::Smaller, GLFW_KEY_LEFT_BRACKET, 0, "[", "Paint", "Smaller brush"},
    {Action::Larger, GLFW_KEY_RIGHT_BRACKET, 0, "]", "Paint", "Larger brush"},
    {Action::Swap, GLFW_KEY_X, 0, "X", "Paint", "Swap primary and secondary profile"},
    {Action::Pick, GLFW_KEY_S, 0, "S", "Paint", "Pick the profile under the cursor"},
    {Action::Undo, GLFW_KEY_Z, kControl, "Ctrl+Z", "Paint", "Undo"},
    {Action::Redo, GLFW_KEY_Z, kControl | kShift, "Ctrl+Shift+Z", "Paint", "Redo (or Ctrl+Y)"},
    {Action::Redo, GLFW_KEY_Y, kControl, "Ctrl+Y", "Paint", nullptr},
    {Action::Cancel, GLFW_KEY_ESCAPE, 0, "Esc", "Paint", "Give up a stroke; close what is open"},
    {Action::Paint, GLFW_KEY_B, 0, "B, M", "Paint", "Brush paints, brush selects"},
    {Action::Select, GLFW_KEY_M, 0, "", "Paint", nullptr},
    {Action::SelectAll, GLFW_KEY_A, kControl, "Ctrl+A, D, I", "Paint",
     "Select all, nothing, the rest"},
    {Action::SelectNone, GLFW_KEY_D, kControl, "", "Paint", nullptr},
    {Action::SelectInvert, GLFW_KEY_I, kControl, "", "Paint", nullptr},
    {Action::Frame, GLFW_KEY_HOME, 0, "Home", "View", "Fit the object into the view"},
    {Action::Frame, GLFW_KEY_KP_DECIMAL, 0, "Num .", "View", nullptr},
    {Action::Front, GLFW_KEY_KP_1, 0, "Num 1, 3, 7", "View", "Front, right, top (Ctrl: opposite)"},
    {Action::Right, GLFW_KEY_KP_3, 0, "", "View", nullptr},
    {Action::Top, GLFW_KEY_KP_7, 0, "", "View", nullptr},
    {Action::Back, GLFW_KEY_KP_1, kControl, "", "View", nullptr},
    {Action::Left, GLFW_KEY_KP_3, kControl, "", "View", nullptr},
    {Action::Bottom, GLFW_KEY_KP_7, kControl, "", "View", nullptr},
    {Action::TurnLeft, GLFW_KEY_KP_4, 0, "Num 2, 4, 6, 8", "View", "Turn by 15\xc2\xb0"},
    {Action::TurnRight, GLFW_KEY_KP_6, 0, "", "View", nullptr},
    {Action::TurnUp, GLFW_KEY_KP_8, 0, "", "View", nullptr},
    {Action::TurnDown, GLFW_KEY_KP_2, 0, "", "View", nullptr},
    {Action::Initial, GLFW_KEY_KP_0, 0, "Num 0", "View", "The view that the scene opened with"},
    {Action::Projection, GLFW_KEY_KP_5, 0, "Num 5", "View", "Perspective or orthographic"},
    {Action::Play, GLFW_KEY_SPACE, 0, "Space", "Motion", "Play or stop; a model at rest turns"},
    {Action::Turntable, GLFW_KEY_SPACE, kShift, "Shift+Space", "Motion",
     "Turntable: the object turns, the light stays"},
    {Action::StepBack, GLFW_KEY_COMMA, 0, ", .", "Motion", "A frame back or on (1/24 s)"},
    {Action::StepOn, GLFW_KEY_PERIOD, 0, "", "Motion", nullptr},
    {Action::Key, GLFW_KEY_K, 0, "K", "Motion", "Deform: a key at this moment"},
    {Action::Panels, GLFW_KEY_H, 0, "H", "Window", "Hide or show the panels"},
    {Action::FullScreen, GLFW_KEY_F11, 0, "F11", "Window", "Full screen"},
    {Action::Help, GLFW_KEY_F1, 0, "F1 or ?", "Window", "These shortcuts"},
    {Action::Help, GLFW_KEY_SLASH, kShift, "?", "Window", nullptr},
    {Action::Open, GLFW_KEY_O, kControl, "Ctrl+O", "Files", "Open a model"},
    {Action::Save, GLFW_KEY_S, kControl, "Ctrl+S", "Files", "Save the material"},
    {Action::SaveAs, GLFW_KEY_S, kControl | kShift, "Ctrl+Shift+S", "Files", "Save it as"},
    {Action::Quit, GLFW_KEY_Q, kControl, "Ctrl+Q", "Files", "Quit"},
};

constexpr MouseHelp kMouse[] = {
    {"Left", "Paint; beside the object: turn the view"},
    {"Left on a dot", "Drag a light, a control point, a handle"},
    {"Ctrl+Left", "Paint the other way: darken, harden, secondary profile"},
    {"Middle, Alt+Left", "Turn the view"},
    {"Shift+Middle, Alt+Middle", "Shift the view"},
    {"Wheel, Alt+Right", "Zoom at the cursor"},
};

} // namespace

std::span<const Shortcut> shortcuts() {
    return kShortcuts;
}

const Shortcut* findShortcut(int key, int modifiers) {
    const int relevant = modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT);
    for (const Shortcut& shortcut : kShortcuts) {
        if (shortcut.key == key && shortcut.modifiers == relevant) {
            return &shortcut;
        }
    }
    return nullptr;
}

std::span<const MouseHelp> mouseHelp() {
    return kMouse;
}

} // namespace celadon::ui
