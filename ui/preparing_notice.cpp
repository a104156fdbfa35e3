#include "ui/preparing_notice.h"

#include "ui/theme.h"
#include "ui/viewport.h"

#include <fmt/format.h>
#include <imgui.h>

namespace celadon::ui {

std::string preparingText(const Session& session) {
    const subedit::MaterialMap* largest = nullptr; // its tables take longest
    const auto texels = [](const subedit::MaterialMap& map) {
        return static_cast<double>(map.width) * map.height;
    };
    for (int i = 0; i < session.materialCount(); ++i) {
        const subedit::Document* const document = session.document(i);
        if (document != nullptr &&
            (largest == nullptr || texels(document->material()) > texels(*largest))) {
            largest = &document->material();
        }
    }
    return largest != nullptr ? fmt::format("makes the light's tables of {} x {} texels",
                                            largest->width, largest->height)
                              : "compiles shaders";
}

void drawPreparing(ImDrawList& list, const ViewportRect& rect, const std::string& text) {
    const ImVec2 low(static_cast<float>(rect.origin.x), static_cast<float>(rect.origin.y));
    const ImVec2 high(low.x + static_cast<float>(rect.size.x),
                      low.y + static_cast<float>(rect.size.y));
    ImVec4 shade = palette().well;
    shade.w = 0.8f;
    list.AddRectFilled(low, high, ImGui::GetColorU32(shade));
    const auto addLine = [&](Font which, const ImVec4& color, const char* line, float lines) {
        ImGui::PushFont(font(which));
        const ImVec2 size = ImGui::CalcTextSize(line);
        list.AddText({0.5f * (low.x + high.x - size.x), 0.5f * (low.y + high.y) + lines * size.y},
                     ImGui::GetColorU32(color), line);
        ImGui::PopFont();
    };
    addLine(Font::Body, palette().text, "Preparing the first picture \xe2\x80\xa6", -1.0f);
    addLine(Font::Small, palette().muted, text.c_str(), 0.3f);
}

} // namespace celadon::ui
