#include "ui/panels/menu_bar.h"

#include "renderer/scene/builtin.h"
#include "ui/material_library.h"
#include "ui/view_names.h"

#include <imgui.h>

#include <array>

namespace celadon::ui {

namespace {

void item(const char* label, const std::string& shortcut, const std::function<void()>& act,
          bool enabled = true) {
    if (ImGui::MenuItem(label, shortcut.c_str(), false, enabled)) {
        act();
    }
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
    item("Open model\xe2\x80\xa6", keys.text(Action::Open), actions.openModel);
    if (ImGui::BeginMenu("Builtin models")) {
        for (const std::string& name : builtinNames()) {
            if (ImGui::MenuItem(materialLabel(name).c_str())) {
                actions.open("builtin:" + name);
            }
        }
        ImGui::EndMenu();
    }
    drawRecent("Recent models", context.preferences.recentModels, actions.open);
    item("Open material\xe2\x80\xa6", "", actions.openMaterial);
    drawRecent("Recent materials", context.preferences.recentMaterials, actions.putOn);
    item("Open environment\xe2\x80\xa6", "", actions.openEnvironment);
    ImGui::Separator();
    const bool hasMaterial = context.session.activeDocument() != nullptr;
    item("Save material", keys.text(Action::Save), actions.save, hasMaterial);
    item("Save material as\xe2\x80\xa6", keys.text(Action::SaveAs), actions.saveAs, hasMaterial);
    ImGui::Separator();
    const bool hasWorld = context.session.hasWorld();
    item("Open deformers\xe2\x80\xa6", "", actions.openDeformers, hasWorld);
    item("Save deformers\xe2\x80\xa6", "", actions.saveDeformers, hasWorld);
    ImGui::Separator();
    item("Export glTF and SubEdit\xe2\x80\xa6", "", actions.exportGltf, hasMaterial);
    item("Save picture\xe2\x80\xa6", "", actions.savePicture, hasWorld);
    if (ImGui::MenuItem("Save turntable\xe2\x80\xa6", nullptr, false, hasWorld)) {
        actions.saveTurntable(context.state.turntableFrames);
    }
    ImGui::Separator();
    item("Quit", keys.text(Action::Quit), actions.quit);
}

void drawEditMenu(const LayoutContext& context) {
    Session& session = context.session;
    const subedit::Document* const document = session.activeDocument();
    const std::optional<std::string> undo = session.undoTitle();
    const std::optional<std::string> redo = session.redoTitle();
    const KeyMap& keys = context.preferences.keys;
    const auto command = [&session](const char* label, const std::string& shortcut, Command action,
                                    bool enabled) {
        if (ImGui::MenuItem(label, shortcut.c_str(), false, enabled)) {
            session.perform(action);
        }
    };
    command(("Undo " + undo.value_or("")).c_str(), keys.text(Action::Undo), {"edit.undo"},
            undo.has_value());
    command(("Redo " + redo.value_or("")).c_str(), keys.text(Action::Redo), {"edit.redo"},
            redo.has_value());
    ImGui::Separator();
    const bool has = document != nullptr;
    command("Fill the selection", "", {"edit.fill"}, has);
    command("Swap profiles", keys.text(Action::Swap), {"profile.swap"}, true);
    ImGui::Separator();
    command("Select all", keys.text(Action::SelectAll), {"select.change", {{"what", "all"}}}, has);
    command("Select nothing", keys.text(Action::SelectNone), {"select.change", {{"what", "none"}}},
            has);
    command("Invert the selection", keys.text(Action::SelectInvert),
            {"select.change", {{"what", "invert"}}}, has);
    ImGui::Separator();
    if (ImGui::MenuItem("Preferences\xe2\x80\xa6")) {
        context.state.preferencesShown = true;
    }
}

void drawViewMenu(const LayoutContext& context) {
    Session& session = context.session;
    for (const ViewName& name : viewNames()) {
        if (ImGui::MenuItem(name.label, nullptr, session.view.mode.mode == name.mode)) {
            session.perform({"view.mode", {{"name", std::string(name.word)}}});
        }
    }
    ImGui::Separator();
    const KeyMap& keys = context.preferences.keys;
    struct Side {
        const char* label;
        Action action;
        const char* word;
    };
    for (const auto& [label, action, word] :
         {Side{"Front", Action::Front, "front"}, Side{"Right", Action::Right, "right"},
          Side{"Top", Action::Top, "top"}}) {
        if (ImGui::MenuItem(label, keys.text(action).c_str())) {
            session.perform({"camera.view", {{"name", word}}});
        }
    }
    if (ImGui::MenuItem("Frame the model", keys.text(Action::Frame).c_str())) {
        session.perform({"camera.frame", {{"aspect", session.aspect}}});
    }
    if (ImGui::MenuItem("Play", keys.text(Action::Play).c_str(), session.motion.isPlaying,
                        session.hasWorld() && session.mover().durationSeconds() > 0.0)) {
        context.actions.togglePlay();
    }
    if (ImGui::MenuItem("Turntable", keys.text(Action::Turntable).c_str(),
                        context.state.isTurning)) {
        context.actions.toggleTurntable();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Panels", keys.text(Action::Panels).c_str(), context.state.panelsShown)) {
        context.state.panelsShown = !context.state.panelsShown;
    }
    item("Full screen", keys.text(Action::FullScreen), context.actions.toggleFullScreen);
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
        if (ImGui::MenuItem("Shortcuts", context.preferences.keys.text(Action::Help).c_str())) {
            context.state.helpShown = true;
        }
        ImGui::EndMenu();
    }
    context.state.openMenu.clear();
    ImGui::EndMainMenuBar();
}

} // namespace celadon::ui
