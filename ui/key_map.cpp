#include "ui/key_map.h"

#include "subedit/errors.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

namespace celadon::ui {

namespace {

constexpr int kControl = GLFW_MOD_CONTROL;
constexpr int kShift = GLFW_MOD_SHIFT;
constexpr int kModifiers = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT;

constexpr ActionInfo kActions[] = {
    {Action::Radius, "radius", "Brush radius", {GLFW_KEY_F, 0}},
    {Action::Strength, "strength", "Flow", {GLFW_KEY_F, kShift}},
    {Action::Smaller, "smaller", "Smaller brush", {GLFW_KEY_LEFT_BRACKET, 0}},
    {Action::Larger, "larger", "Larger brush", {GLFW_KEY_RIGHT_BRACKET, 0}},
    {Action::Swap, "swap", "Swap profiles", {GLFW_KEY_X, 0}},
    {Action::Pick, "pick", "Pick a profile", {GLFW_KEY_S, 0}},
    {Action::Undo, "undo", "Undo", {GLFW_KEY_Z, kControl}},
    {Action::Redo, "redo", "Redo", {GLFW_KEY_Z, kControl | kShift}},
    {Action::Cancel, "cancel", "Cancel", {GLFW_KEY_ESCAPE, 0}},
    {Action::Paint, "paint", "Brush paints", {GLFW_KEY_B, 0}},
    {Action::Select, "select", "Brush selects", {GLFW_KEY_M, 0}},
    {Action::SelectAll, "select-all", "Select all", {GLFW_KEY_A, kControl}},
    {Action::SelectNone, "select-none", "Select nothing", {GLFW_KEY_D, kControl}},
    {Action::SelectInvert, "select-invert", "Invert the selection", {GLFW_KEY_I, kControl}},
    {Action::Frame, "frame", "Frame the model", {GLFW_KEY_HOME, 0}},
    {Action::Front, "front", "View from the front", {GLFW_KEY_KP_1, 0}},
    {Action::Right, "right", "View from the right", {GLFW_KEY_KP_3, 0}},
    {Action::Top, "top", "View from the top", {GLFW_KEY_KP_7, 0}},
    {Action::Back, "back", "View from the back", {GLFW_KEY_KP_1, kControl}},
    {Action::Left, "left", "View from the left", {GLFW_KEY_KP_3, kControl}},
    {Action::Bottom, "bottom", "View from below", {GLFW_KEY_KP_7, kControl}},
    {Action::TurnLeft, "turn-left", "Turn left", {GLFW_KEY_KP_4, 0}},
    {Action::TurnRight, "turn-right", "Turn right", {GLFW_KEY_KP_6, 0}},
    {Action::TurnUp, "turn-up", "Turn up", {GLFW_KEY_KP_8, 0}},
    {Action::TurnDown, "turn-down", "Turn down", {GLFW_KEY_KP_2, 0}},
    {Action::Initial, "initial", "The first view", {GLFW_KEY_KP_0, 0}},
    {Action::Projection, "projection", "Perspective", {GLFW_KEY_KP_5, 0}},
    {Action::Play, "play", "Play", {GLFW_KEY_SPACE, 0}},
    {Action::Turntable, "turntable", "Turntable", {GLFW_KEY_SPACE, kShift}},
    {Action::StepBack, "step-back", "A frame back", {GLFW_KEY_COMMA, 0}},
    {Action::StepOn, "step-on", "A frame on", {GLFW_KEY_PERIOD, 0}},
    {Action::Key, "key", "Key of a deformer", {GLFW_KEY_K, 0}},
    {Action::Panels, "panels", "Panels", {GLFW_KEY_H, 0}},
    {Action::FullScreen, "full-screen", "Full screen", {GLFW_KEY_F11, 0}},
    {Action::Help, "help", "Shortcuts", {GLFW_KEY_F1, 0}},
    {Action::Open, "open", "Open a model", {GLFW_KEY_O, kControl}},
    {Action::Save, "save", "Save the material", {GLFW_KEY_S, kControl}},
    {Action::SaveAs, "save-as", "Save the material as", {GLFW_KEY_S, kControl | kShift}},
    {Action::Quit, "quit", "Quit", {GLFW_KEY_Q, kControl}},
};
static_assert(std::size(kActions) == static_cast<std::size_t>(Action::Count));

/// Second ways, as long as nothing else was given these keys.
struct OtherWay {
    KeyChord chord;
    Action action;
};
constexpr OtherWay kOtherWays[] = {
    {{GLFW_KEY_Y, kControl}, Action::Redo},
    {{GLFW_KEY_KP_DECIMAL, 0}, Action::Frame},
    {{GLFW_KEY_SLASH, kShift}, Action::Help},
};

struct KeyName {
    int key;
    const char* name;
};
constexpr KeyName kNames[] = {{GLFW_KEY_SPACE, "Space"},
                              {GLFW_KEY_ESCAPE, "Esc"},
                              {GLFW_KEY_ENTER, "Enter"},
                              {GLFW_KEY_TAB, "Tab"},
                              {GLFW_KEY_COMMA, "Comma"},
                              {GLFW_KEY_PERIOD, "Period"},
                              {GLFW_KEY_BACKSPACE, "Back"},
                              {GLFW_KEY_INSERT, "Insert"},
                              {GLFW_KEY_DELETE, "Delete"},
                              {GLFW_KEY_RIGHT, "Right"},
                              {GLFW_KEY_LEFT, "Left"},
                              {GLFW_KEY_DOWN, "Down"},
                              {GLFW_KEY_UP, "Up"},
                              {GLFW_KEY_PAGE_UP, "Page up"},
                              {GLFW_KEY_PAGE_DOWN, "Page down"},
                              {GLFW_KEY_HOME, "Home"},
                              {GLFW_KEY_END, "End"},
                              {GLFW_KEY_KP_DECIMAL, "Num ."},
                              {GLFW_KEY_KP_DIVIDE, "Num /"},
                              {GLFW_KEY_KP_MULTIPLY, "Num *"},
                              {GLFW_KEY_KP_SUBTRACT, "Num -"},
                              {GLFW_KEY_KP_ADD, "Num +"},
                              {GLFW_KEY_KP_ENTER, "Num Enter"}};

std::string keyName(int key) {
    for (const KeyName& known : kNames) {
        if (known.key == key) {
            return known.name;
        }
    }
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) {
        return fmt::format("Num {}", key - GLFW_KEY_KP_0);
    }
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) {
        return fmt::format("F{}", key - GLFW_KEY_F1 + 1);
    }
    // GLFW numbers printable keys by their character on a US keyboard.
    return key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT
               ? std::string(1, static_cast<char>(key))
               : std::string();
}

struct ModifierName {
    int modifier;
    std::string_view name;
};
constexpr ModifierName kModifierNames[] = {
    {GLFW_MOD_CONTROL, "Ctrl+"}, {GLFW_MOD_ALT, "Alt+"}, {GLFW_MOD_SHIFT, "Shift+"}};

constexpr MouseHelp kMouse[] = {
    {"Left", "Paint; beside the object: turn the view"},
    {"Left on a dot", "Drag a light, a control point, a handle"},
    {"Ctrl+Left", "Paint the other way: darken, harden, secondary profile"},
    {"Middle, Alt+Left", "Turn the view"},
    {"Shift+Middle, Alt+Middle", "Shift the view"},
    {"Wheel, Alt+Right", "Zoom at the cursor"},
    {"Ctrl+Left on a slider", "Type its number"},
};

} // namespace

std::string chordText(KeyChord chord) {
    const std::string name = keyName(chord.key);
    std::string text;
    for (const ModifierName& known : kModifierNames) {
        if (!name.empty() && (chord.modifiers & known.modifier) != 0) {
            text += known.name;
        }
    }
    text += name;
    return text;
}

std::optional<KeyChord> parseChord(std::string_view text) {
    KeyChord chord;
    for (const ModifierName& known : kModifierNames) {
        if (text.starts_with(known.name) && text.size() > known.name.size()) {
            chord.modifiers |= known.modifier;
            text.remove_prefix(known.name.size());
        }
    }
    if (text.empty()) {
        return chord.modifiers == 0 ? std::optional(KeyChord{}) : std::nullopt;
    }
    for (int key = GLFW_KEY_SPACE; key <= GLFW_KEY_LAST; ++key) {
        if (keyName(key) == text) {
            chord.key = key;
            return chord;
        }
    }
    return std::nullopt;
}

bool repeats(Action action) {
    using enum Action;
    constexpr std::array kRepeating{Smaller,   Larger, Undo,     Redo,     TurnLeft,
                                    TurnRight, TurnUp, TurnDown, StepBack, StepOn};
    return std::ranges::find(kRepeating, action) != kRepeating.end();
}

std::span<const ActionInfo> actionInfos() {
    return kActions;
}

const char* actionName(Action action) {
    return kActions[static_cast<std::size_t>(action)].name;
}

Action parseAction(std::string_view name) {
    for (const ActionInfo& info : kActions) {
        if (info.name == name) {
            return info.action;
        }
    }
    throw UsageError(fmt::format("action '{}'", name), "there is no such action");
}

KeyMap::KeyMap() {
    for (const ActionInfo& info : kActions) {
        mChords[static_cast<std::size_t>(info.action)] = info.usual;
    }
}

std::optional<Action> KeyMap::find(KeyChord pressed) const {
    pressed.modifiers &= kModifiers;
    const auto found = std::find(mChords.begin(), mChords.end(), pressed);
    if (pressed.key != 0 && found != mChords.end()) {
        return static_cast<Action>(found - mChords.begin());
    }
    for (const OtherWay& other : kOtherWays) {
        if (other.chord == pressed) {
            return other.action;
        }
    }
    return std::nullopt;
}

KeyChord KeyMap::chord(Action action) const {
    return mChords[static_cast<std::size_t>(action)];
}

std::string KeyMap::texts(const std::vector<Action>& actions) const {
    std::string result;
    for (const Action action : actions) {
        const std::string key = text(action);
        if (!key.empty()) {
            result += fmt::format("{}{}", result.empty() ? "" : ", ", key);
        }
    }
    return result;
}

std::string KeyMap::withKeys(std::string help, const std::vector<Action>& actions) const {
    const std::string keys = texts(actions);
    return keys.empty() ? help : fmt::format("{} ({})", help, keys);
}

void KeyMap::set(Action action, KeyChord chord) {
    chord.modifiers &= kModifiers;
    if (chord.key != 0) {
        std::replace(mChords.begin(), mChords.end(), chord, KeyChord{});
    }
    mChords[static_cast<std::size_t>(action)] = chord;
}

std::map<std::string, std::string> KeyMap::changes() const {
    std::map<std::string, std::string> result;
    for (const ActionInfo& info : kActions) {
        if (chord(info.action) != info.usual) {
            result[info.name] = text(info.action);
        }
    }
    return result;
}

void KeyMap::apply(const std::map<std::string, std::string>& changes) {
    for (const ActionInfo& info : kActions) {
        const auto found = changes.find(info.name);
        if (found == changes.end()) {
            continue;
        }
        if (const std::optional<KeyChord> chord = parseChord(found->second)) {
            set(info.action, *chord);
        }
    }
}

std::span<const HelpLine> helpLines() {
    using enum Action;
    static const std::vector<HelpLine> lines{
        {"Paint", {Radius}, "Brush radius: move the mouse, click"},
        {"Paint", {Strength}, "Flow: move the mouse, click"},
        {"Paint", {Smaller, Larger}, "Smaller, larger brush"},
        {"Paint", {Swap}, "Swap primary and secondary profile"},
        {"Paint", {Pick}, "Pick the profile under the cursor"},
        {"Paint", {Undo, Redo}, "Undo, redo"},
        {"Paint", {Cancel}, "Give up a stroke; close what is open"},
        {"Paint", {Paint, Select}, "Brush paints, brush selects"},
        {"Paint", {SelectAll, SelectNone, SelectInvert}, "Select all, nothing, the rest"},
        {"Files", {Open}, "Open a model"},
        {"Files", {Save, SaveAs}, "Save the material, save it as"},
        {"Files", {Quit}, "Quit"},
        {"View", {Frame}, "Fit the object into the view"},
        {"View", {Front, Right, Top}, "Front, right, top"},
        {"View", {Back, Left, Bottom}, "Back, left, below"},
        {"View", {TurnDown, TurnLeft, TurnRight, TurnUp}, "Turn by 15\xc2\xb0"},
        {"View", {Initial}, "The view that the scene opened with"},
        {"View", {Projection}, "Perspective or orthographic"},
        {"Motion", {Play}, "Play or stop; a model at rest turns"},
        {"Motion", {Turntable}, "Turntable: the object turns, the light stays"},
        {"Motion", {StepBack, StepOn}, "A frame back or on (1/24 s)"},
        {"Motion", {Key}, "Deform: a key at this moment"},
        {"Window", {Panels}, "Hide or show the panels"},
        {"Window", {FullScreen}, "Full screen"},
        {"Window", {Help}, "These shortcuts (or ?)"},
    };
    return lines;
}

std::span<const MouseHelp> mouseHelp() {
    return kMouse;
}

} // namespace celadon::ui
