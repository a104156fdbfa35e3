#include "ui/panels/help_window.h"

#include "ui/shortcuts.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>

namespace celadon::ui {

namespace {

void row(const char* keys, const char* help) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(colors::kAccent, "%s", keys);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(help);
}

void table(const char* group) {
    heading(group);
    if (ImGui::BeginTable(group, 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const Shortcut& shortcut : shortcuts()) {
            if (shortcut.help != nullptr && std::strcmp(shortcut.group, group) == 0) {
                row(shortcut.keys, shortcut.help);
            }
        }
        ImGui::EndTable();
    }
}

} // namespace

void drawHelpWindow(bool& isShown, float scale) {
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
        const bool isWide = display.x > 780.0f * scale;
        if (ImGui::BeginTable("columns", isWide ? 2 : 1, ImGuiTableFlags_SizingFixedFit)) {
            ImGui::TableNextColumn();
            table("Paint");
            table("Files");
            ImGui::TableNextColumn();
            heading("Mouse");
            if (ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingFixedFit)) {
                for (const MouseHelp& help : mouseHelp()) {
                    row(help.keys, help.help);
                }
                ImGui::EndTable();
            }
            table("View");
            table("Window");
            ImGui::EndTable();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace celadon::ui
