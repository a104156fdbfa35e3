#include "ui/panels/menu_bar.h"

#include "renderer/scene/builtin.h"
#include "ui/material_library.h"
#include "ui/view_names.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <array>

namespace celadon::ui {

namespace {

/// @param help what it does, shown when the cursor rests on it
/// @return whether it was chosen
bool item(const char* label, const std::string& shortcut, const char* help, bool isOn = false,
          bool enabled = true) {
    const bool isChosen = ImGui::MenuItem(label, shortcut.c_str(), isOn, enabled);
    tooltip(help);
    return isChosen;
}

/// Opens a menu by itself when a script asks for it, and closes it for another one.
bool beginMenu(const LayoutState& state, const char* label, std::string_view word) {
    const bool isAsked = state.openMenu == word;
    if (isAsked) {
        ImGui::OpenPopup(label);
    }
    const bool isOpen = ImGui::BeginMenu(label);
    if (isOpen && !state.openMenu.empty() && !isAsked) {
        ImGui::CloseCurrentPopup();
    }
    return isOpen;
}

void drawRecent(const char* label, const std::vector<std::string>& entries,
                const std::function<void(const std::string&)>& open) {
    if (ImGui::BeginMenu(label, !entries.empty())) {
        for (const std::string& entry : entries) {
            if (ImGui::MenuItem(entry.c_str())) {
                open(entry);
                break;
            }
        }
        ImGui::EndMenu();
    }
}

void drawFileMenu(const LayoutContext& context) {
    const LayoutActions& actions = context.actions;
    const KeyMap& keys = context.preferences.keys;
    const bool hasMaterial = context.session.activeDocument() != nullptr;
    const bool hasWorld = context.session.hasWorld();
    const auto act = [](const char* label, const std::string& shortcut, const char* help,
                        const std::function<void()>& action, bool enabled = true) {
        if (item(label, shortcut, help, false, enabled)) {
            action();
        }
    };
    act("Open model\xe2\x80\xa6", keys.text(Action::Open),
        "glTF, OBJ, PLY, OFF or STL, to paint on", actions.openModel);
    if (ImGui::BeginMenu("Builtin models")) {
        for (const std::string& name : builtinNames()) {
            if (item(materialLabel(name).c_str(), "", "A model that the program makes")) {
                actions.open("builtin:" + name);
            }
        }
        ImGui::EndMenu();
    }
    drawRecent("Recent models", context.preferences.recentModels, actions.open);
    act("Open material\xe2\x80\xa6", "", "Puts a SubEdit material (.subedit.exr) on the model",
        actions.openMaterial);
    drawRecent("Recent materials", context.preferences.recentMaterials, actions.putOn);
    act("Open environment\xe2\x80\xa6", "",
        "Light from all around: a latitude-longitude map, .hdr or .exr", actions.openEnvironment);
    ImGui::Separator();
    act("Save material", keys.text(Action::Save),
        "Every material with changes, into the file that it came from or was saved to",
        actions.save, hasMaterial);
    act("Save material as\xe2\x80\xa6", keys.text(Action::SaveAs),
        "The material in hand, into another file", actions.saveAs, hasMaterial);
    ImGui::Separator();
    act("Open deformers\xe2\x80\xa6", "",
        "Twists, lattices, handles and their keys from a .json file", actions.openDeformers,
        hasWorld);
    act("Save deformers\xe2\x80\xa6", "",
        "A .json file, or a copy of the open glTF, that celadon render takes",
        actions.saveDeformers, hasWorld);
    ImGui::Separator();
    act("Export glTF and SubEdit\xe2\x80\xa6", "",
        "The model with its materials beside it, and what other programs read of them",
        actions.exportGltf, hasMaterial);
    act("Save picture\xe2\x80\xa6", "", "The picture in the viewport, as it is now",
        actions.savePicture, hasWorld);
    if (item("Save turntable\xe2\x80\xa6", "", "A whole turn around the model, a picture a frame",
             false, hasWorld)) {
        actions.saveTurntable(context.state.turntableFrames);
    }
    ImGui::Separator();
    act("Quit", keys.text(Action::Quit), "Asks first where changes are not saved", actions.quit);
}

void drawEditMenu(const LayoutContext& context) {
    Session& session = context.session;
    const subedit::Document* const document = session.activeDocument();
    const std::optional<std::string> undo = session.undoTitle();
    const std::optional<std::string> redo = session.redoTitle();
    const KeyMap& keys = context.preferences.keys;
    const auto command = [&session](const char* label, const std::string& shortcut,
                                    const char* help, const Command& action, bool enabled) {
        if (item(label, shortcut, help, false, enabled)) {
            session.perform(action);
        }
    };
    command(("Undo " + undo.value_or("")).c_str(), keys.text(Action::Undo),
            "Takes back the last change: of a material, deformers, lights or a profile",
            {"edit.undo"}, undo.has_value());
    command(("Redo " + redo.value_or("")).c_str(), keys.text(Action::Redo),
            "Repeats what was taken back last", {"edit.redo"}, redo.has_value());
    ImGui::Separator();
    const bool has = document != nullptr;
    command("Fill the selection", "", "Applies the brush's operator to all that is selected",
            {"edit.fill"}, has);
    command("Swap profiles", keys.text(Action::Swap), "Primary and secondary profile",
            {"profile.swap"}, true);
    ImGui::Separator();
    command("Select all", keys.text(Action::SelectAll), "Strokes and fills reach everything",
            {"select.change", {{"what", "all"}}}, has);
    command("Select nothing", keys.text(Action::SelectNone), "Strokes and fills reach nothing",
            {"select.change", {{"what", "none"}}}, has);
    command("Invert the selection", keys.text(Action::SelectInvert),
            "What was left out, and only that", {"select.change", {{"what", "invert"}}}, has);
    ImGui::Separator();
    if (item("Preferences\xe2\x80\xa6", "", "Theme, scale, keys, journal, memory of the history")) {
        context.state.preferencesShown = true;
    }
}

void drawViewMenu(const LayoutContext& context) {
    Session& session = context.session;
    for (const ViewName& name : viewNames()) {
        if (item(name.label, "", name.explanation, session.view.mode.mode == name.mode)) {
            session.perform({"view.mode", {{"name", std::string(name.word)}}});
        }
    }
    ImGui::Separator();
    const KeyMap& keys = context.preferences.keys;
    struct Side {
        const char* label;
        Action action;
        const char* word;
        const char* help;
    };
    for (const auto& [label, action, word, help] :
         {Side{"Front", Action::Front, "front", "Looks along -z"},
          Side{"Right", Action::Right, "right", "Looks along -x"},
          Side{"Top", Action::Top, "top", "Looks along -y"}}) {
        if (item(label, keys.text(action), help)) {
            session.perform({"camera.view", {{"name", word}}});
        }
    }
    if (item("Frame the model", keys.text(Action::Frame), "All of it, from where one looks")) {
        session.perform({"camera.frame", {{"aspect", session.aspect}}});
    }
    if (item("Play", keys.text(Action::Play),
             "The animation of the glTF, or keyed deformers; a model at rest turns",
             session.motion.isPlaying, session.hasWorld())) {
        context.actions.togglePlay();
    }
    if (item("Turntable", keys.text(Action::Turntable), "Turns around the model",
             context.state.isTurning)) {
        context.actions.toggleTurntable();
    }
    ImGui::Separator();
    if (item("Panels", keys.text(Action::Panels), "Shows and hides all but the picture",
             context.state.panelsShown)) {
        context.state.panelsShown = !context.state.panelsShown;
    }
    if (item("Full screen", keys.text(Action::FullScreen), "The window fills the screen")) {
        context.actions.toggleFullScreen();
    }
}

} // namespace

void drawMenuBar(const LayoutContext& context) {
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    if (beginMenu(context.state, "File", "file")) {
        drawFileMenu(context);
        ImGui::EndMenu();
    }
    if (beginMenu(context.state, "Edit", "edit")) {
        drawEditMenu(context);
        ImGui::EndMenu();
    }
    if (beginMenu(context.state, "View", "view")) {
        drawViewMenu(context);
        ImGui::EndMenu();
    }
    if (beginMenu(context.state, "Help", "help")) {
        if (item("Shortcuts", context.preferences.keys.text(Action::Help),
                 "All keys and what the mouse does")) {
            context.state.helpShown = true;
        }
        ImGui::EndMenu();
    }
    context.state.openMenu.clear();
    ImGui::EndMainMenuBar();
}

} // namespace celadon::ui
