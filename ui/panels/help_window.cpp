#include "ui/panels/help_window.h"

#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <string>

namespace celadon::ui {

namespace {

constexpr float kKeysWidth = 15.0f; ///< in font sizes

void row(const char* keys, const char* help) {
    const float width = ImGui::CalcTextSize(keys).x;
    ImGui::TextColored(palette().accent, "%s", keys);
    ImGui::SameLine(0.0f, std::max(kKeysWidth * ImGui::GetFontSize() - width, 4.0f));
    ImGui::TextUnformatted(help);
}

void list(const KeyMap& keys, const char* group) {
    heading(group);
    for (const HelpLine& line : helpLines()) {
        if (std::strcmp(line.group, group) != 0) {
            continue;
        }
        row(keys.texts(line.actions).c_str(), line.help);
    }
}

} // namespace

void drawHelpWindow(const KeyMap& keys, bool& isShown, float scale) {
    if (!isShown) {
        return;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {display.x, display.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 8.0f * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {22.0f * scale, 16.0f * scale});
    if (ImGui::Begin("Shortcuts", &isShown,
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings)) {
        const bool isWide = display.x > 900.0f * scale;
        ImGui::BeginGroup();
        list(keys, "Paint");
        list(keys, "Files");
        ImGui::EndGroup();
        if (isWide) {
            ImGui::SameLine(0.0f, 36.0f * scale);
        }
        ImGui::BeginGroup();
        heading("Mouse");
        for (const MouseHelp& help : mouseHelp()) {
            row(help.keys, help.help);
        }
        list(keys, "View");
        list(keys, "Motion");
        list(keys, "Window");
        ImGui::EndGroup();
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace celadon::ui
