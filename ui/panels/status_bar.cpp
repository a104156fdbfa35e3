#include "ui/panels/status_bar.h"

#include "ui/theme.h"
#include "ui/view_names.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

namespace {

void drawCancel(const LayoutContext& context, float height) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {6.0f * context.scale, 0.0f});
    if (ImGui::Button("Cancel", {0.0f, height})) {
        context.actions.cancelJobs();
    }
    ImGui::PopStyleVar();
}

std::string qualityText(const Viewport& viewport) {
    const int shown = viewport.shownRung();
    if (shown < 0) {
        return "";
    }
    constexpr std::array<const char*, 4> kNames{"draft", "default", "final", "sketch"};
    const Rung& rung = viewport.ladder().rungs()[static_cast<std::size_t>(shown)];
    const char* const quality = kNames[static_cast<std::size_t>(rung.quality)];
    return rung.divisor > 1 ? fmt::format("{} 1/{}", quality, rung.divisor) : quality;
}

void drawJob(const LayoutContext& context, const BackgroundJobs::Running& job) {
    const float height = ImGui::GetFontSize() + 2.0f * context.scale;
    ImGui::TextColored(palette().accent, "%s", job.title.c_str());
    ImGui::SameLine();
    ImGui::ProgressBar(static_cast<float>(job.fraction), {140.0f * context.scale, height},
                       fmt::format("{:.0f} %", 100.0 * job.fraction).c_str());
    ImGui::SameLine();
    drawCancel(context, height);
}

} // namespace

float statusBarHeight(float scale) {
    return 26.0f * scale;
}

void drawStatusBar(const LayoutContext& context) {
    const Session& session = context.session;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float scale = context.scale;
    ImGui::SetNextWindowPos({0.0f, size.y - statusBarHeight(scale)});
    ImGui::SetNextWindowSize({size.x, statusBarHeight(scale)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0f * scale, 4.0f * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
    if (ImGui::Begin("##status", nullptr, kFixedWindow | ImGuiWindowFlags_NoScrollbar)) {
        ImGui::PushFont(font(Font::Small));
        if (!context.state.activity.empty()) {
            ImGui::TextColored(palette().warning, "%s", context.state.activity.c_str());
            if (context.state.canCancel) {
                ImGui::SameLine();
                drawCancel(context, ImGui::GetFontSize() + 2.0f * scale);
            }
        } else if (context.state.job) {
            drawJob(context, *context.state.job);
        } else if (session.hasWorld()) {
            const std::string text =
                fmt::format("{}   \xc2\xb7   {:.4g} mm across{}", session.opened().model,
                            2.0 * session.world().scatteringSphere.radius,
                            session.isAnythingModified() ? "   \xc2\xb7   not saved" : "");
            ImGui::TextDisabled("%s", text.c_str());
            tooltip("The model, and the diameter of what scatters, mm");
        }
        const Viewport& viewport = context.viewport;
        const std::string right = viewport.shownRung() < 0
                                      ? std::string()
                                      : fmt::format("{}   \xc2\xb7   {:.0f} ms{}",
                                                    qualityText(viewport), viewport.shown().timeMs,
                                                    viewport.isWaiting() ? "   \xe2\x80\xa6" : "");
        ImGui::SameLine(
            std::max(0.0f, size.x - ImGui::CalcTextSize(right.c_str()).x - 12.0f * scale));
        ImGui::TextDisabled("%s", right.c_str());
        tooltip("Quality and size of the picture on screen, and the time it took, ms");
        ImGui::PopFont();
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

void drawViewportHint(const LayoutContext& context) {
    if (!context.session.hasWorld()) {
        return;
    }
    const float scale = context.scale;
    const ViewportRect& rect = context.viewport.rect();
    const ViewMode mode = context.session.view.mode.mode;
    const std::string what = mode == ViewMode::Picture ? "" : viewName(mode).label;
    const std::string hint = context.tools.hint();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImGui::PushFont(font(Font::Small));
    const float line = ImGui::GetTextLineHeight();
    const auto pill = [&](const std::string& text, float y, ImU32 color) {
        const float x = static_cast<float>(rect.origin.x) + 12.0f * scale;
        const float room = static_cast<float>(rect.size.x) - 24.0f * scale;
        const float width = std::min(ImGui::CalcTextSize(text.c_str()).x, room - 16.0f * scale);
        const ImVec2 low(x, y);
        const ImVec2 high(x + width + 16.0f * scale, y + line + 8.0f * scale);
        list.AddRectFilled(low, high, IM_COL32(14, 16, 17, 170), 5.0f * scale);
        list.PushClipRect(low, high, true);
        list.AddText({low.x + 8.0f * scale, low.y + 4.0f * scale}, color, text.c_str());
        list.PopClipRect();
    };
    const float bottom = static_cast<float>(rect.origin.y + rect.size.y);
    if (!hint.empty()) {
        pill(hint, bottom - line - 20.0f * scale, IM_COL32(198, 206, 203, 255));
    }
    if (!what.empty()) {
        pill(what, static_cast<float>(rect.origin.y) + 12.0f * scale,
             ImGui::GetColorU32(palette().accent));
    }
    ImGui::PopFont();
}

} // namespace celadon::ui
