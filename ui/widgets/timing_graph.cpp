#include "ui/widgets/timing_graph.h"

#include "ui/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

std::array<StageRow, kStageCount> stageRows(const StageMilliseconds& stages) {
    double splatting = 0.0;
    for (const double level : stages.splatting) {
        splatting += level;
    }
    const auto known = [](double timeMs) { return std::isfinite(timeMs) ? timeMs : 0.0; };
    return {{{"Irradiance buffer", IM_COL32(240, 228, 100, 255), known(stages.irradianceBuffer)},
             {"Splatting buffer", IM_COL32(230, 159, 40, 255), known(stages.splattingBuffer)},
             {"Selection", IM_COL32(204, 121, 167, 255), known(stages.selection)},
             {"Splatting", IM_COL32(86, 180, 233, 255), known(splatting)},
             {"Accumulation", IM_COL32(40, 130, 200, 255), known(stages.accumulation)},
             {"Shading", IM_COL32(30, 165, 125, 255), known(stages.shading)}}};
}

void drawTimingGraph(const Viewport& viewport, float heightPx) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::InvisibleButton("##timings", {width, heightPx});
    const ImVec2 high(low.x + width, low.y + heightPx);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, ImGui::GetColorU32(palette().well), 4.0f);
    double most = 20.0;
    for (const Viewport::Timing& timing : viewport.timings()) {
        most = std::max(most, timing.totalMs);
    }
    most = 20.0 * std::ceil(most / 20.0);
    list.PushClipRect(low, high, true);
    constexpr float kBars = 90.0f;
    const float bar = width / kBars;
    float x = high.x - bar * static_cast<float>(viewport.timings().size());
    const Viewport::Timing* hovered = nullptr;
    const float mouse = ImGui::IsItemHovered() ? ImGui::GetIO().MousePos.x : -1.0f;
    for (const Viewport::Timing& timing : viewport.timings()) {
        float y = high.y;
        const auto add = [&](double timeMs, ImU32 color) {
            const float top = y - static_cast<float>(timeMs / most) * heightPx;
            list.AddRectFilled({x, top}, {x + std::max(bar - 1.0f, 1.0f), y}, color);
            y = top;
        };
        double sum = 0.0;
        for (const StageRow& stage : stageRows(timing.stages)) {
            add(stage.timeMs, stage.color);
            sum += stage.timeMs;
        }
        add(std::max(0.0, timing.totalMs - sum), IM_COL32(110, 116, 114, 255));
        if (mouse >= x && mouse < x + bar) {
            hovered = &timing;
        }
        x += bar;
    }
    list.PopClipRect();
    ImGui::PushFont(font(Font::Small));
    list.AddText({low.x + 5.0f, low.y + 2.0f}, ImGui::GetColorU32(palette().muted),
                 fmt::format("{:.0f} ms", most).c_str());
    ImGui::PopFont();
    if (hovered != nullptr) {
        std::string text = fmt::format("Picture: {:.1f} ms", hovered->totalMs);
        for (const StageRow& stage : stageRows(hovered->stages)) {
            text += fmt::format("\n{}: {:.1f} ms", stage.name, stage.timeMs);
        }
        ImGui::SetTooltip("%s", text.c_str());
    }
}

} // namespace celadon::ui
