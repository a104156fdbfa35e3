#include "subedit/errors.h"
#include "tests/support/temporary_folder.h"
#include "ui/preferences_commands.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace celadon::ui {
namespace {

TEST(KeyMap, EveryUsualKeyHasANameAndDoesOneThing) {
    const KeyMap keys;
    std::set<std::string> texts;
    std::set<std::string> names;
    std::size_t index = 0;
    for (const ActionInfo& info : actionInfos()) {
        EXPECT_EQ(static_cast<std::size_t>(info.action), index++) << info.name;
        const std::string text = keys.text(info.action);
        EXPECT_FALSE(text.empty()) << info.name;
        EXPECT_TRUE(texts.insert(text).second) << text << " is used twice";
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_EQ(parseChord(text), info.usual) << text;
        EXPECT_EQ(keys.find(info.usual), info.action) << text;
    }
    EXPECT_EQ(keys.find({GLFW_KEY_Y, GLFW_MOD_CONTROL}), Action::Redo);
    EXPECT_EQ(keys.find({GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_CAPS_LOCK}), Action::Undo);
    EXPECT_FALSE(keys.find({GLFW_KEY_J, 0}));
    EXPECT_FALSE(keys.find({}));
}

TEST(KeyMap, EveryActionIsInTheHelp) {
    std::set<Action> helped;
    for (const HelpLine& line : helpLines()) {
        helped.insert(line.actions.begin(), line.actions.end());
    }
    EXPECT_EQ(helped.size(), actionInfos().size());
}

TEST(KeyMap, AKeyThatIsTakenIsLost) {
    KeyMap keys;
    keys.set(Action::Save, {GLFW_KEY_X, 0});
    EXPECT_EQ(keys.find({GLFW_KEY_X, 0}), Action::Save);
    EXPECT_EQ(keys.text(Action::Swap), "");
    EXPECT_FALSE(keys.find({GLFW_KEY_S, GLFW_MOD_CONTROL}));
    keys.set(Action::Play, {GLFW_KEY_Y, GLFW_MOD_CONTROL}); // the second way to redo
    EXPECT_EQ(keys.find({GLFW_KEY_Y, GLFW_MOD_CONTROL}), Action::Play);
    KeyMap same;
    same.apply(keys.changes());
    EXPECT_EQ(same, keys);
}

TEST(KeyMap, RubbishIsPassedOver) {
    KeyMap keys;
    keys.apply({{"undo", "Ctrl+"}, {"redo", "Hyper+Q"}, {"sing", "Q"}, {"save", "F99"}});
    EXPECT_EQ(keys, KeyMap());
    EXPECT_FALSE(parseChord("Ctrl+Ctrl+Z"));
    EXPECT_EQ(parseChord(""), KeyChord{});
}

TEST(Preferences, WhatIsWrittenReadsBack) {
    const test::TemporaryFolder folder;
    const auto file = folder / "p.json";
    Preferences preferences;
    preferences.theme = Theme::Light;
    preferences.uiScale = 1.5;
    preferences.undoMegabytes = 300.0;
    preferences.keys.set(Action::Undo, {GLFW_KEY_KP_ADD, GLFW_MOD_ALT});
    preferences.keys.set(Action::Quit, {});
    writePreferences(preferences, file);
    const Preferences back = readPreferences(file);
    EXPECT_EQ(back.theme, Theme::Light);
    EXPECT_EQ(back.uiScale, 1.5);
    EXPECT_EQ(back.undoMegabytes, 300.0);
    EXPECT_EQ(back.keys, preferences.keys);
    EXPECT_EQ(back.keys.text(Action::Undo), "Alt+Num +");
}

TEST(Preferences, WhatIsWrongTakesItsDefault) {
    const test::TemporaryFolder folder;
    const auto file = folder / "p.json";
    for (const char* text : {R"({"theme": "pink", "keys": [1], "uiScale": -3, "autosave": 7,
                             "undoMegabytes": -1})",
                             R"({"theme": 1, "keys": {"undo": 5}})", "[]", "no JSON", ""}) {
        std::ofstream(file) << text;
        const Preferences read = readPreferences(file);
        EXPECT_EQ(read.theme, Theme::Dark) << text;
        EXPECT_EQ(read.keys, KeyMap()) << text;
        EXPECT_EQ(read.uiScale, 0.0) << text;
        EXPECT_EQ(read.undoMegabytes, 512.0) << text;
        EXPECT_TRUE(read.autosave) << text;
    }
}

TEST(Preferences, CommandsChangeThemOrLeaveThemAsTheyAre) {
    Preferences preferences;
    int told = 0;
    Dispatcher commands;
    addPreferencesCommands(commands, preferences, [&told] { ++told; });
    int recorded = 0;
    commands.observe([&recorded](const Command&) { ++recorded; });
    commands.execute({"preferences.change",
                      {{"theme", "light"}, {"scale", 1.5}, {"undo", 300.0}, {"journal", false}}});
    EXPECT_EQ(preferences.theme, Theme::Light);
    EXPECT_EQ(preferences.uiScale, 1.5);
    EXPECT_EQ(preferences.undoMegabytes, 300.0);
    EXPECT_FALSE(preferences.autosave);
    EXPECT_EQ(preferences.frameBudgetMs, 100.0);
    for (const ActionInfo& info : actionInfos()) { // any key that can be shown can be said
        commands.execute({"preferences.key", {{"action", info.name}, {"key", "Ctrl+Shift+J"}}});
        EXPECT_EQ(preferences.keys.text(info.action), "Ctrl+Shift+J");
    }
    commands.execute({"preferences.key", {{"action", "undo"}, {"key", ""}}});
    EXPECT_EQ(preferences.keys.text(Action::Undo), "");
    commands.execute({"preferences.usualKeys", {}});
    EXPECT_EQ(preferences.keys, KeyMap());
    EXPECT_EQ(recorded, 0);
    const int toldSoFar = told;
    EXPECT_EQ(toldSoFar, static_cast<int>(actionInfos().size()) + 3);

    for (const Command& wrong :
         {Command{"preferences.change", {{"scale", 1.0}, {"theme", "pink"}}},
          Command{"preferences.change", {{"theme", "gray"}, {"scale", 9.0}}},
          Command{"preferences.key", {{"action", "sing"}, {"key", "Q"}}},
          Command{"preferences.key", {{"action", "undo"}, {"key", "Hyper+Q"}}}}) {
        EXPECT_THROW(commands.execute(wrong), UsageError);
    }
    EXPECT_EQ(preferences.theme, Theme::Light);
    EXPECT_EQ(preferences.uiScale, 1.5);
    EXPECT_EQ(preferences.keys, KeyMap());
    EXPECT_EQ(told, toldSoFar);
}

} // namespace
} // namespace celadon::ui
