#include "ui/layout.h"

#include "subedit/errors.h"
#include "ui/panels/brush_panel.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/help_window.h"
#include "ui/panels/light_panel.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/menu_bar.h"
#include "ui/panels/notices.h"
#include "ui/panels/preferences_window.h"
#include "ui/panels/profile_panel.h"
#include "ui/panels/status_bar.h"
#include "ui/panels/view_panel.h"
#include "ui/theme.h"
#include "ui/widgets/held_change.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

namespace {

constexpr float kSideBarWidth = 318.0f;

float menuHeight() {
    return ImGui::GetFrameHeight();
}

struct Named {
    Tab tab;
    const char* label;
    std::string_view word;
};
constexpr std::array<Named, 6> kTabs{{{Tab::Brush, "Brush", "brush"},
                                      {Tab::Profile, "Profile", "profile"},
                                      {Tab::Materials, "Material", "material"},
                                      {Tab::Light, "Light", "light"},
                                      {Tab::Deform, "Deform", "deform"},
                                      {Tab::View, "View", "view"}}};

/// Side bar that leaves at least half of a narrow window to the picture.
float sideBarWidth(float windowWidth, float scale) {
    return std::min(kSideBarWidth * scale, 0.5f * windowWidth);
}

void drawTabs(LayoutState& state) {
    // As wide as the words, and the rest shared.
    const float gap = 2.0f;
    float rest = ImGui::GetContentRegionAvail().x - gap * (kTabs.size() - 1);
    for (const Named& named : kTabs) {
        rest -= ImGui::CalcTextSize(named.label).x;
    }
    const float margin = std::max(rest / kTabs.size(), 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0f, ImGui::GetStyle().FramePadding.y});
    for (const Named& named : kTabs) {
        if (named.tab != kTabs.front().tab) {
            ImGui::SameLine(0.0f, gap);
        }
        const bool isCurrent = named.tab == state.tab;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              isCurrent ? palette().accentDim : ImVec4(0.0f, 0.0f, 0.0f, 0.0f));
        if (ImGui::Button(named.label, {ImGui::CalcTextSize(named.label).x + margin, 0.0f})) {
            state.tab = named.tab;
        }
        ImGui::PopStyleColor();
    }
    ImGui::PopStyleVar();
}

void drawPanel(const LayoutContext& context) {
    letGoOfHeld(context.session);
    switch (context.state.tab) {
    case Tab::View:
        drawViewPanel(context);
        break;
    case Tab::Light:
        drawLightPanel(context.session, context.actions);
        break;
    case Tab::Deform:
        drawDeformPanel(context);
        break;
    case Tab::Brush:
        drawBrushPanel(context);
        break;
    case Tab::Profile:
        drawProfilePanel(context.session);
        break;
    case Tab::Materials:
        drawMaterialPanel(context);
        break;
    }
}

void drawSideBar(const LayoutContext& context) {
    LayoutState& state = context.state;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = sideBarWidth(size.x, context.scale);
    ImGui::SetNextWindowPos({size.x - width, menuHeight()});
    ImGui::SetNextWindowSize(
        {width, std::max(1.0f, size.y - menuHeight() - statusBarHeight(context.scale))});
    if (ImGui::Begin("##side", nullptr, kFixedWindow)) {
        drawTabs(state);
        ImGui::Separator();
        const char* const panel = kTabs[static_cast<std::size_t>(state.tab)].label; // scrolls alone
        if (ImGui::BeginChild(panel) && context.session.hasWorld()) {
            drawPanel(context);
            if (state.scrollTo) {
                ImGui::SetScrollY(static_cast<float>(*state.scrollTo) * ImGui::GetScrollMaxY());
                state.scrollTo.reset();
            }
        }
        ImGui::EndChild();
    }
    ImGui::End();
}

} // namespace

Tab parseTab(std::string_view word) {
    for (const Named& named : kTabs) {
        if (named.word == word) {
            return named.tab;
        }
    }
    throw UsageError(fmt::format("tab '{}'", word), "there is no such tab",
                     "choose brush, profile, material, light, deform or view");
}

ViewportRect viewportRect(glm::ivec2 windowPx, const LayoutState& state, float scale) {
    ViewportRect rect;
    if (!state.panelsShown) {
        rect.size = glm::max(windowPx, glm::ivec2(1));
        return rect;
    }
    const int top = static_cast<int>(menuHeight());
    const int right = static_cast<int>(sideBarWidth(static_cast<float>(windowPx.x), scale));
    const int bottom = static_cast<int>(statusBarHeight(scale));
    rect.origin = {0, top};
    rect.size = glm::max(windowPx - glm::ivec2(right, top + bottom), glm::ivec2(1));
    return rect;
}

void drawLayout(const LayoutContext& context) {
    MotionState& motion = context.session.motion;
    motion.areControlsShown = context.state.tab == Tab::Deform;
    motion.isAddingHandles &= motion.areControlsShown;
    ImGui::BeginDisabled(context.state.isRecovering);
    if (context.state.panelsShown) {
        drawViewportHint(context);
        drawMenuBar(context);
        drawSideBar(context);
        drawStatusBar(context);
    }
    ImGui::EndDisabled();
    context.viewport.wantCounts(context.state.panelsShown && context.state.tab == Tab::View);
    drawNotices(context);
    drawHelpWindow(context.preferences.keys, context.state.helpShown, context.scale);
    drawPreferencesWindow(context);
}

} // namespace celadon::ui
