#include "ui/panels/help_window.h"

#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace celadon::ui {

namespace {

struct Row {
    std::string keys;
    const char* help;
};
struct Group {
    const char* title;
    std::vector<Row> rows;
};

Group groupOf(const KeyMap& keys, const char* title) {
    Group group{title, {}};
    for (const HelpLine& line : helpLines()) {
        if (std::strcmp(line.group, title) == 0) {
            group.rows.push_back({keys.texts(line.actions), line.help});
        }
    }
    return group;
}

Group mouseGroup() {
    Group group{"Mouse", {}};
    for (const MouseHelp& help : mouseHelp()) {
        group.rows.push_back({help.keys, help.help});
    }
    return group;
}

/// Groups below each other, keys in a column as wide as they need.
void drawColumn(const std::vector<Group>& groups) {
    float width = 0.0f;
    for (const Group& group : groups) {
        for (const Row& row : group.rows) {
            width = std::max(width, ImGui::CalcTextSize(row.keys.c_str()).x);
        }
    }
    ImGui::BeginGroup();
    for (const Group& group : groups) {
        heading(group.title);
        for (const Row& row : group.rows) {
            ImGui::TextColored(palette().accent, "%s", row.keys.c_str());
            ImGui::SameLine(width + 1.5f * ImGui::GetFontSize());
            ImGui::TextUnformatted(row.help);
        }
    }
    ImGui::EndGroup();
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
        const bool isWide = display.x > 940.0f * scale;
        drawColumn({groupOf(keys, "Paint"), groupOf(keys, "Files"), groupOf(keys, "Window")});
        if (isWide) {
            ImGui::SameLine(0.0f, 36.0f * scale);
        }
        drawColumn({mouseGroup(), groupOf(keys, "View"), groupOf(keys, "Motion")});
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace celadon::ui
