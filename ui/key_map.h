#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Which keys do what: one table for the keyboard, the menus, the help and the preferences.
namespace celadon::ui {

enum class Action {
    Radius,
    Strength,
    Smaller,
    Larger,
    Swap,
    Pick,
    Undo,
    Redo,
    Cancel,
    Paint,
    Select,
    SelectAll,
    SelectNone,
    SelectInvert,
    Frame,
    Front,
    Right,
    Top,
    Back,
    Left,
    Bottom,
    TurnLeft,
    TurnRight,
    TurnUp,
    TurnDown,
    Initial,
    Projection,
    Play,
    Turntable,
    StepBack,
    StepOn,
    Key,
    Panels,
    FullScreen,
    Help,
    Open,
    Save,
    SaveAs,
    Quit,
    Count
};

/// Goes on while its key is held.
[[nodiscard]] bool repeats(Action action);

/// A key with exactly these of control, shift and alt; key 0: none.
struct KeyChord {
    int key = 0;       ///< GLFW's
    int modifiers = 0; ///< GLFW's
    bool operator==(const KeyChord&) const = default;
};

/// "Ctrl+Shift+Z", "Num 1", "["; empty for none and for keys without a name.
[[nodiscard]] std::string chordText(KeyChord chord);
/// The inverse; "" is none. Nothing for what is no key.
[[nodiscard]] std::optional<KeyChord> parseChord(std::string_view text);

struct ActionInfo {
    Action action;
    const char* name; ///< in files
    const char* label;
    KeyChord usual;
};
/// In the order of Action.
[[nodiscard]] std::span<const ActionInfo> actionInfos();
/// In files and commands.
[[nodiscard]] const char* actionName(Action action);
/// @throws UsageError
[[nodiscard]] Action parseAction(std::string_view name);

class KeyMap {
public:
    KeyMap(); ///< the usual keys

    /// Nothing when a key does nothing.
    [[nodiscard]] std::optional<Action> find(KeyChord pressed) const;
    [[nodiscard]] KeyChord chord(Action action) const;
    /// For menus and tooltips.
    [[nodiscard]] std::string text(Action action) const { return chordText(chord(action)); }
    /// A tooltip with the keys of actions at its end.
    [[nodiscard]] std::string withKeys(std::string help, const std::vector<Action>& actions) const;
    /// The keys of actions in a row.
    [[nodiscard]] std::string texts(const std::vector<Action>& actions) const;
    /// Another action that had the chord is left without.
    void set(Action action, KeyChord chord);

    /// Names of actions and texts of chords that are not the usual ones.
    [[nodiscard]] std::map<std::string, std::string> changes() const;
    /// What it cannot read is passed over.
    void apply(const std::map<std::string, std::string>& changes);

    bool operator==(const KeyMap&) const = default;

private:
    std::array<KeyChord, static_cast<std::size_t>(Action::Count)> mChords;
};

/// A line of the help: actions that belong together.
struct HelpLine {
    const char* group;
    std::vector<Action> actions;
    const char* help;
};
[[nodiscard]] std::span<const HelpLine> helpLines();

/// What the mouse does, for the help: keys and meaning.
struct MouseHelp {
    const char* keys;
    const char* help;
};
[[nodiscard]] std::span<const MouseHelp> mouseHelp();

} // namespace celadon::ui
