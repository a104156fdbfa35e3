#include "ui/panels/notices.h"

#include "ui/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace celadon::ui {

namespace {

ImVec4 colorOf(Notice::Kind kind) {
    return kind == Notice::Kind::Error     ? palette().error
           : kind == Notice::Kind::Warning ? palette().warning
                                           : palette().accent;
}

} // namespace

void drawNotices(const LayoutContext& context) {
    std::vector<Notice>& notices = context.session.notices;
    const ViewportRect& rect = context.viewport.rect();
    const float scale = context.scale;
    const bool isNamed = context.session.view.mode.mode != ViewMode::Picture;
    float y = static_cast<float>(rect.origin.y) + (isNamed ? 42.0f : 12.0f) * scale;
    for (std::size_t i = 0; i < notices.size(); ++i) {
        const float width =
            std::min(static_cast<float>(rect.size.x) - 24.0f * scale, 460.0f * scale);
        ImGui::SetNextWindowPos({static_cast<float>(rect.origin.x) + 12.0f * scale, y});
        ImGui::SetNextWindowSize({std::max(width, 80.0f), 0.0f});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0f * scale);
        bool isDismissed = false;
        if (ImGui::Begin(fmt::format("##notice{}", i).c_str(), nullptr,
                         (kFixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                             ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoScrollbar)) {
            const float button = ImGui::GetFrameHeight();
            ImGui::PushStyleColor(ImGuiCol_Text, colorOf(notices[i].kind));
            ImGui::PushTextWrapPos(ImGui::GetContentRegionMax().x - button - 6.0f * scale);
            ImGui::TextUnformatted(notices[i].text.c_str());
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
            notices.erase(notices.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        }
    }
}

} // namespace celadon::ui
