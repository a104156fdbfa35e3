#include "ui/layout.h"

#include "subedit/errors.h"
#include "ui/panels/brush_panel.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/help_window.h"
#include "ui/panels/light_panel.h"
#include "ui/panels/material_panel.h"
#include "ui/panels/preferences_window.h"
#include "ui/panels/profile_panel.h"
#include "ui/panels/view_panel.h"
#include "ui/theme.h"
#include "ui/view_names.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

namespace {

constexpr float kSideBarWidth = 318.0f;
constexpr float kStatusHeight = 26.0f;
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

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

void drawMenu(Session& session, LayoutState& state, const Preferences& preferences,
              const LayoutActions& actions) {
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    const auto item = [](const char* label, const char* shortcut, const std::function<void()>& act,
                         bool enabled = true) {
        if (ImGui::MenuItem(label, shortcut, false, enabled && act) && act) {
            act();
        }
    };
    if (ImGui::BeginMenu("File")) {
        item("Open model\xe2\x80\xa6", "Ctrl+O", actions.openModel);
        if (ImGui::BeginMenu("Builtin models")) {
            for (const char* name : {"vase", "shell", "sphere", "slab"}) {
                if (ImGui::MenuItem(name)) {
                    actions.open(std::string("builtin:") + name);
                }
            }
            ImGui::EndMenu();
        }
        drawRecent("Recent models", preferences.recentModels, actions.open);
        drawRecent("Recent materials", preferences.recentMaterials, actions.putOn);
        item("Open material\xe2\x80\xa6", "", actions.openMaterial);
        item("Open environment\xe2\x80\xa6", "", actions.openEnvironment);
        ImGui::Separator();
        item("Save material", "Ctrl+S", actions.save);
        item("Save material as\xe2\x80\xa6", "Ctrl+Shift+S", actions.saveAs);
        item("Save picture\xe2\x80\xa6", "", actions.savePicture);
        ImGui::Separator();
        item("Quit", "Ctrl+Q", actions.quit);
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Edit")) {
        const subedit::Document* const document = session.activeDocument();
        const bool canUndo = document != nullptr && document->canUndo();
        const bool canRedo = document != nullptr && document->canRedo();
        if (ImGui::MenuItem(canUndo ? ("Undo " + document->undoTitle()).c_str() : "Undo", "Ctrl+Z",
                            false, canUndo)) {
            session.perform({"edit.undo"});
        }
        if (ImGui::MenuItem(canRedo ? ("Redo " + document->redoTitle()).c_str() : "Redo",
                            "Ctrl+Shift+Z", false, canRedo)) {
            session.perform({"edit.redo"});
        }
        ImGui::Separator();
        if (ImGui::MenuItem("Fill", nullptr, false, document != nullptr)) {
            session.perform({"edit.fill"});
        }
        if (ImGui::MenuItem("Swap profiles", "X")) {
            session.perform({"profile.swap"});
        }
        ImGui::Separator();
        if (ImGui::MenuItem("Preferences\xe2\x80\xa6")) {
            state.preferencesShown = true;
        }
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("View")) {
        for (const ViewName& name : viewNames()) {
            if (ImGui::MenuItem(name.label, nullptr, session.view.mode.mode == name.mode)) {
                session.perform({"view.mode", {{"name", std::string(name.word)}}});
            }
        }
        ImGui::Separator();
        if (ImGui::MenuItem("Panels", "H", state.panelsShown)) {
            state.panelsShown = !state.panelsShown;
        }
        item("Full screen", "F11", actions.toggleFullScreen);
        ImGui::EndMenu();
    }
    if (ImGui::BeginMenu("Help")) {
        if (ImGui::MenuItem("Shortcuts", "F1")) {
            state.helpShown = true;
        }
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

void drawSideBar(Session& session, LayoutState& state, const LayoutActions& actions,
                 const Viewport& viewport, float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float width = sideBarWidth(size.x, scale);
    ImGui::SetNextWindowPos({size.x - width, menuHeight()});
    ImGui::SetNextWindowSize(
        {width, std::max(1.0f, size.y - menuHeight() - kStatusHeight * scale)});
    if (ImGui::Begin("##side", nullptr, kFixed)) {
        const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
        const float each =
            (ImGui::GetContentRegionAvail().x - gap * (kTabs.size() - 1)) / kTabs.size();
        for (const Named& named : kTabs) {
            if (named.tab != kTabs.front().tab) {
                ImGui::SameLine(0.0f, gap);
            }
            const bool isCurrent = named.tab == state.tab;
            ImGui::PushStyleColor(ImGuiCol_Button,
                                  isCurrent ? colors::kAccentDim : ImVec4(0.0f, 0.0f, 0.0f, 0.0f));
            if (ImGui::Button(named.label, {each, 0.0f})) {
                state.tab = named.tab;
            }
            ImGui::PopStyleColor();
        }
        ImGui::Separator();
        if (ImGui::BeginChild("##panel") && session.hasWorld()) {
            switch (state.tab) {
            case Tab::View:
                drawViewPanel(session, viewport);
                break;
            case Tab::Light:
                drawLightPanel(session);
                break;
            case Tab::Deform:
                drawDeformPanel(session, {actions.openDeformers, actions.saveDeformers});
                break;
            case Tab::Brush:
                drawBrushPanel(session);
                break;
            case Tab::Profile:
                drawProfilePanel(session);
                break;
            case Tab::Materials:
                drawMaterialPanel(session, actions.putOn);
                break;
            }
            if (state.scrollTo) {
                ImGui::SetScrollY(static_cast<float>(*state.scrollTo) * ImGui::GetScrollMaxY());
                state.scrollTo.reset();
            }
        }
        ImGui::EndChild();
    }
    ImGui::End();
}

std::string qualityText(const Viewport& viewport) {
    const int shown = viewport.shownRung();
    if (shown < 0) {
        return "";
    }
    constexpr std::array<const char*, 4> kNames{"sketch", "draft", "default", "final"};
    const Rung& rung = viewport.ladder().rungs()[static_cast<std::size_t>(shown)];
    const char* const quality = kNames[static_cast<std::size_t>(rung.quality)];
    return rung.divisor > 1 ? fmt::format("{} 1/{}", quality, rung.divisor) : quality;
}

void drawStatus(Session& session, const LayoutState& state, const Viewport& viewport, float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.0f, size.y - kStatusHeight * scale});
    ImGui::SetNextWindowSize({size.x, kStatusHeight * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0f * scale, 4.0f * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {0.082f, 0.088f, 0.092f, 1.0f});
    if (ImGui::Begin("##status", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar)) {
        ImGui::PushFont(font(Font::Small));
        if (!state.activity.empty()) {
            ImGui::TextColored(colors::kWarning, "%s", state.activity.c_str());
        } else if (session.hasWorld()) {
            ImGui::TextDisabled("%s", fmt::format("{}   \xc2\xb7   {:.1f} mm across",
                                                  session.opened().model,
                                                  2.0 * session.world().scatteringSphere.radius)
                                          .c_str());
        }
        const std::string right = viewport.shownRung() < 0
                                      ? std::string()
                                      : fmt::format("{}   \xc2\xb7   {:.0f} ms{}",
                                                    qualityText(viewport), viewport.shown().timeMs,
                                                    viewport.isWaiting() ? "   \xe2\x80\xa6" : "");
        ImGui::SameLine(
            std::max(0.0f, size.x - ImGui::CalcTextSize(right.c_str()).x - 12.0f * scale));
        ImGui::TextDisabled("%s", right.c_str());
        ImGui::PopFont();
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

void drawNotices(Session& session, const ViewportRect& rect, float scale) {
    float y = static_cast<float>(rect.origin.y) + 12.0f * scale;
    for (std::size_t i = 0; i < session.notices.size(); ++i) {
        const Notice& notice = session.notices[i];
        const ImVec4 color = notice.kind == Notice::Kind::Error     ? colors::kError
                             : notice.kind == Notice::Kind::Warning ? colors::kWarning
                                                                    : colors::kAccent;
        const float width =
            std::min(static_cast<float>(rect.size.x) - 24.0f * scale, 460.0f * scale);
        ImGui::SetNextWindowPos({static_cast<float>(rect.origin.x) + 12.0f * scale, y});
        ImGui::SetNextWindowSize({std::max(width, 80.0f), 0.0f});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, {0.13f, 0.138f, 0.142f, 0.97f});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0f * scale);
        bool isDismissed = false;
        if (ImGui::Begin(fmt::format("##notice{}", i).c_str(), nullptr,
                         (kFixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                             ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoScrollbar)) {
            const float button = ImGui::GetFrameHeight();
            ImGui::PushStyleColor(ImGuiCol_Text, color);
            ImGui::PushTextWrapPos(ImGui::GetContentRegionMax().x - button - 6.0f * scale);
            ImGui::TextUnformatted(notice.text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::PopStyleColor();
            ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
            isDismissed = ImGui::Button("\xc3\x97", {button, button});
            y += ImGui::GetWindowHeight() + 8.0f * scale;
        }
        ImGui::End();
        ImGui::PopStyleVar();
        ImGui::PopStyleColor();
        if (isDismissed) {
            session.notices.erase(session.notices.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        }
    }
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
    const int bottom = static_cast<int>(kStatusHeight * scale);
    rect.origin = {0, top};
    rect.size = glm::max(windowPx - glm::ivec2(right, top + bottom), glm::ivec2(1));
    return rect;
}

void drawLayout(Session& session, LayoutState& state, Preferences& preferences,
                const LayoutActions& actions, const Viewport& viewport, float scale) {
    if (state.panelsShown) {
        drawMenu(session, state, preferences, actions);
        drawSideBar(session, state, actions, viewport, scale);
        drawStatus(session, state, viewport, scale);
    }
    drawNotices(session, viewport.rect(), scale);
    drawHelpWindow(state.helpShown, scale);
    if (drawPreferencesWindow(preferences, state.preferencesShown, scale)) {
        actions.preferencesChanged();
    }
}

} // namespace celadon::ui
