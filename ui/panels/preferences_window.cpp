#include "ui/panels/preferences_window.h"

#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

bool drawPreferencesWindow(Preferences& preferences, bool& isShown, float scale) {
    if (!isShown) {
        return false;
    }
    bool isChanged = false;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(460.0f * scale, 0.95f * display.x), 0.0f});
    if (ImGui::Begin("Preferences", &isShown,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings)) {
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
