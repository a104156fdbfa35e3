#include "ui/panels/preferences_window.h"

#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

/// A list of actions; a click on a key asks for another one.
bool drawKeys(KeyMap& keys, std::optional<Action>& keyWantedFor, float scale) {
    heading("Keys");
    const float height = std::min(170.0f * scale, 0.22f * ImGui::GetIO().DisplaySize.y);
    if (ImGui::BeginChild("##keys", {0.0f, height}, true)) {
        for (const ActionInfo& info : actionInfos()) {
            ImGui::PushID(info.name);
            ImGui::AlignTextToFramePadding();
            ImGui::TextUnformatted(info.label);
            const float width = 130.0f * scale;
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
    const bool isUsual = keys == KeyMap();
    ImGui::BeginDisabled(isUsual);
    const bool isReset = ImGui::Button("The usual keys");
    ImGui::EndDisabled();
    if (isReset) {
        keys = KeyMap();
    }
    return isReset;
}

} // namespace

bool drawPreferencesWindow(Preferences& preferences, bool& isShown,
                           std::optional<Action>& keyWantedFor, float scale) {
    if (!isShown) {
        keyWantedFor.reset();
        return false;
    }
    bool isChanged = false;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    const float width = std::min(460.0f * scale, 0.95f * display.x);
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, display.y});
    if (ImGui::Begin("Preferences", &isShown,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings)) {
        heading("Theme");
        constexpr std::array<const char*, 3> kThemes{"Dark", "Gray", "Light"};
        constexpr std::array<const char*, 3> kThemeHelps{"Calm", "Neutral, to judge colors by",
                                                         "For bright rooms"};
        const int theme = choiceRow("theme", kThemes.data(), kThemeHelps.data(), 3,
                                    static_cast<int>(preferences.theme));
        if (theme >= 0) {
            preferences.theme = static_cast<Theme>(theme);
            isChanged = true;
        }
        heading("Scale of the interface");
        constexpr std::array<const char*, 5> kLabels{"Display", "100 %", "125 %", "150 %", "200 %"};
        constexpr std::array<double, 5> kScales{0.0, 1.0, 1.25, 1.5, 2.0};
        const auto current = std::find(kScales.begin(), kScales.end(), preferences.uiScale);
        const int chosen =
            choiceRow("scale", kLabels.data(), nullptr, static_cast<int>(kLabels.size()),
                      current == kScales.end() ? -1 : static_cast<int>(current - kScales.begin()));
        if (chosen >= 0) {
            preferences.uiScale = kScales[static_cast<std::size_t>(chosen)];
            isChanged = true;
        }
        heading("While something moves");
        auto budget = static_cast<float>(preferences.frameBudgetMs);
        if (sliderField("Frame time", budget, 16.0f, 400.0f, "%.0f ms",
                        "What a picture may take while you paint or turn; resolution follows. "
                        "Used from the next start on")) {
            preferences.frameBudgetMs = static_cast<double>(budget);
            isChanged = true;
        }
        isChanged |= drawKeys(preferences.keys, keyWantedFor, scale);
        heading("Undo");
        auto undo = static_cast<float>(preferences.undoMegabytes);
        if (sliderField("Memory", undo, 128.0f, 8192.0f, "%.0f MB",
                        "What the history of a material may take. Beyond it the oldest steps can "
                        "no longer be undone",
                        true)) {
            preferences.undoMegabytes = static_cast<double>(std::round(undo));
            isChanged = true;
        }
        heading("Safety");
        isChanged |=
            ImGui::Checkbox("Keep a journal for recovery after a crash", &preferences.autosave);
        tooltip("Each stroke is written to a file as it ends; at most one is lost");
        hint(("Kept in " + preferencesFile().string()).c_str());
    }
    ImGui::End();
    return isChanged;
}

} // namespace celadon::ui
