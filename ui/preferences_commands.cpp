#include "ui/preferences_commands.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace celadon::ui {

namespace {

Theme parseTheme(const std::string& name) {
    for (const Theme theme : {Theme::Dark, Theme::Gray, Theme::Light}) {
        if (name == themeName(theme)) {
            return theme;
        }
    }
    throw UsageError(fmt::format("theme '{}'", name), "there is no such theme",
                     "choose dark, gray or light");
}

Preferences changed(Preferences preferences, const Arguments& a) {
    if (a.has("theme")) {
        preferences.theme = parseTheme(a.text("theme"));
    }
    if (a.has("scale") && a.number("scale") != 0.0) {
        preferences.uiScale = a.numberWithin("scale", 0.5, 4.0);
    } else if (a.has("scale")) {
        preferences.uiScale = 0.0; // the display's
    }
    if (a.has("frame")) {
        preferences.frameBudgetMs = a.numberWithin("frame", 10.0, 1000.0);
    }
    if (a.has("undo")) {
        preferences.undoMegabytes = a.numberWithin("undo", 64.0, 65536.0);
    }
    preferences.autosave = a.flag("journal", preferences.autosave);
    return preferences;
}

} // namespace

void addPreferencesCommands(Dispatcher& commands, Preferences& preferences,
                            std::function<void()> tell) {
    const auto add = [&](const char* name, const char* summary, auto change) {
        commands.add(
            name, summary,
            [&preferences, tell, change](const Arguments& a) {
                change(preferences, a);
                tell();
            },
            false);
    };
    add("preferences.change",
        "theme: dark, gray, light; scale of the interface, 0: the display's; frame: ms of a "
        "picture while something moves; undo: MB of a history; journal",
        [](Preferences& p, const Arguments& a) { p = changed(p, a); });
    add("preferences.key", "Which key does an action: action, key, or no key",
        [](Preferences& p, const Arguments& a) {
            const std::string text = a.text("key", "");
            const std::optional<KeyChord> key = parseChord(text);
            if (!key) {
                throw UsageError(fmt::format("key '{}'", text), "there is no such key",
                                 "write it as the preferences show it, for example Ctrl+K");
            }
            p.keys.set(parseAction(a.text("action")), *key);
        });
    add("preferences.usualKeys", "All keys as they come with the program",
        [](Preferences& p, const Arguments&) { p.keys = KeyMap(); });
}

} // namespace celadon::ui
