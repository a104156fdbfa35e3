#include "ui/panels/preferences_window.h"

#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

void change(Session& session, const char* name, const nlohmann::json& value) {
    session.perform({"preferences.change", {{name, value}}});
}

/// A list of actions; a click on a key asks for another one.
void drawKeys(const LayoutContext& context) {
    heading("Keys");
    const KeyMap& keys = context.preferences.keys;
    std::optional<Action>& keyWantedFor = context.state.keyWantedFor;
    const float height = std::min(170.0f * context.scale, 0.22f * ImGui::GetIO().DisplaySize.y);
    if (ImGui::BeginChild("##keys", {0.0f, height}, true)) {
        for (const ActionInfo& info : actionInfos()) {
            ImGui::PushID(info.name);
            ImGui::AlignTextToFramePadding();
            ImGui::TextUnformatted(info.label);
            const float width = 130.0f * context.scale;
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
            const bool isWanted = keyWantedFor == info.action;
            const std::string text = keys.text(info.action);
            if (isWanted) {
                ImGui::PushStyleColor(ImGuiCol_Button, palette().accentDim);
            }
            if (ImGui::Button(isWanted       ? "press a key"
                              : text.empty() ? "none"
                                             : text.c_str(),
                              {width, 0.0f})) {
                keyWantedFor = info.action;
            }
            if (isWanted) {
                ImGui::PopStyleColor();
            }
            tooltip("Click, then press the key. Backspace: none; Escape: as it is. Another action "
                    "that had the key loses it");
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
    ImGui::BeginDisabled(keys == KeyMap());
    if (ImGui::Button("The usual keys")) {
        context.session.perform({"preferences.usualKeys", {}});
    }
    ImGui::EndDisabled();
}

void drawChoices(const LayoutContext& context) {
    Session& session = context.session;
    const Preferences& preferences = context.preferences;
    heading("Theme");
    constexpr std::array<const char*, 3> kThemes{"Dark", "Gray", "Light"};
    constexpr std::array<const char*, 3> kThemeHelps{"Calm", "Neutral, to judge colors by",
                                                     "For bright rooms"};
    const int theme = choiceRow("theme", kThemes.data(), kThemeHelps.data(), 3,
                                static_cast<int>(preferences.theme));
    if (theme >= 0) {
        change(session, "theme", themeName(static_cast<Theme>(theme)));
    }
    heading("Scale of the interface");
    constexpr std::array<const char*, 5> kLabels{"Display", "100 %", "125 %", "150 %", "200 %"};
    constexpr std::array<double, 5> kScales{0.0, 1.0, 1.25, 1.5, 2.0};
    const auto current = std::find(kScales.begin(), kScales.end(), preferences.uiScale);
    const int chosen =
        choiceRow("scale", kLabels.data(), nullptr, static_cast<int>(kLabels.size()),
                  current == kScales.end() ? -1 : static_cast<int>(current - kScales.begin()));
    if (chosen >= 0) {
        change(session, "scale", kScales[static_cast<std::size_t>(chosen)]);
    }
    heading("While something moves");
    auto budget = static_cast<float>(preferences.frameBudgetMs);
    if (sliderField("Frame time", budget, 16.0f, 400.0f, "%.0f ms",
                    "What a picture may take while you paint or turn; resolution follows. "
                    "Used from the next start on")) {
        change(session, "frame", static_cast<double>(budget));
    }
    drawKeys(context);
    heading("Undo");
    auto undo = static_cast<float>(preferences.undoMegabytes);
    if (sliderField("Memory", undo, 128.0f, 8192.0f, "%.0f MB",
                    "What the history of a material may take. Beyond it the oldest steps can "
                    "no longer be undone",
                    true)) {
        change(session, "undo", static_cast<double>(std::round(undo)));
    }
    heading("Safety");
    bool isKept = preferences.autosave;
    if (ImGui::Checkbox("Keep a journal for recovery after a crash", &isKept)) {
        change(session, "journal", isKept);
    }
    tooltip("Each stroke is written to a file as it ends; at most one is lost");
    hint(("Kept in " + preferencesFile().string()).c_str());
}

} // namespace

void drawPreferencesWindow(const LayoutContext& context) {
    if (!context.state.preferencesShown) {
        context.state.keyWantedFor.reset();
        return;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const float width = std::min(460.0f * context.scale, 0.95f * display.x);
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, display.y});
    if (ImGui::Begin("Preferences", &context.state.preferencesShown,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings)) {
        drawChoices(context);
    }
    ImGui::End();
}

} // namespace celadon::ui
