#include "ui/widgets/profile_plot.h"

#include "subedit/effective_radius.h"
#include "ui/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr std::array<ImU32, 3> kChannelColors{
    IM_COL32(232, 106, 92, 255), IM_COL32(120, 200, 120, 255), IM_COL32(104, 150, 236, 255)};
constexpr float kDecades = 7.0f; ///< shown below the highest value
constexpr float kReachPx = 9.0f;
constexpr float kLn10 = 2.302585f;

struct Axes {
    ImVec2 low, high;    ///< upper left and lower right of the plot
    float topLog = 0.0f; ///< ln P at the upper edge
    float bottomLog = 0.0f;
    float maxRadiusMm = 1.0f;

    [[nodiscard]] ImVec2 at(float radiusMm, float logP) const {
        const float x = radiusMm / maxRadiusMm;
        const float y = (topLog - logP) / (topLog - bottomLog);
        return {low.x + x * (high.x - low.x), low.y + std::clamp(y, 0.0f, 1.0f) * (high.y - low.y)};
    }
    [[nodiscard]] float logAt(float y) const {
        return topLog - (y - low.y) / (high.y - low.y) * (topLog - bottomLog);
    }
};

void drawGrid(ImDrawList& list, const Axes& axes) {
    const ImU32 line = ImGui::GetColorU32(palette().grid);
    const ImU32 text = ImGui::GetColorU32(palette().muted);
    ImGui::PushFont(font(Font::Small));
    const int first = static_cast<int>(std::floor(axes.topLog / kLn10));
    for (int decade = first; static_cast<float>(decade) * kLn10 > axes.bottomLog; decade -= 2) {
        const ImVec2 p = axes.at(0.0f, static_cast<float>(decade) * kLn10);
        list.AddLine(p, {axes.high.x, p.y}, line);
        const std::string label = fmt::format("1e{}", decade);
        list.AddText({axes.high.x - ImGui::CalcTextSize(label.c_str()).x - 3.0f, p.y + 1.0f}, text,
                     label.c_str());
    }
    for (int i = 1; i < 4; ++i) {
        const float radius = axes.maxRadiusMm * static_cast<float>(i) / 4.0f;
        const ImVec2 p = axes.at(radius, axes.topLog);
        list.AddLine(p, {p.x, axes.high.y}, line);
        const std::string label = fmt::format("{:.3g} mm", radius);
        list.AddText({p.x + 3.0f, axes.high.y - ImGui::GetFontSize() - 2.0f}, text, label.c_str());
    }
    ImGui::PopFont();
}

} // namespace

std::optional<KnotDrag> drawProfilePlot(const subedit::StoredProfile& profile, float heightPx) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::InvisibleButton("##plot", {width, heightPx});
    const bool isActive = ImGui::IsItemActive();
    const bool isHovered = ImGui::IsItemHovered();
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID heldId = ImGui::GetID("##held");
    const ImGuiID topId = ImGui::GetID("##top");

    float highest = -1e30f;
    for (const float value : profile.logProfile) {
        highest = std::max(highest, value);
    }
    Axes axes;
    axes.low = {origin.x, origin.y};
    axes.high = {origin.x + width, origin.y + heightPx};
    // The scale stays while a knot is held: what moves is the knot.
    axes.topLog = std::ceil(highest / kLn10 + 0.15f) * kLn10;
    if (isActive && storage.GetInt(heldId, -1) >= 0) {
        axes.topLog = storage.GetFloat(topId, axes.topLog);
    } else {
        storage.SetFloat(topId, axes.topLog);
    }
    axes.bottomLog = axes.topLog - kDecades * kLn10;
    axes.maxRadiusMm = profile.maxRadiusMm;

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(axes.low, axes.high, ImGui::GetColorU32(palette().well), 4.0f);
    list.PushClipRect(axes.low, axes.high, true);
    drawGrid(list, axes);
    const float spacing = profile.maxRadiusMm / static_cast<float>(profile.segments);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    int nearest = -1;
    float nearestPx = kReachPx * kReachPx;
    const glm::dvec3 radius = subedit::effectiveRadiusMm(profile.view(), 0.95);
    std::vector<ImVec2> points(static_cast<std::size_t>(profile.segments) + 1);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k <= profile.segments; ++k) {
            const ImVec2 p = axes.at(spacing * static_cast<float>(k),
                                     profile.logProfile[static_cast<std::size_t>(k * 3 + c)]);
            points[static_cast<std::size_t>(k)] = p;
            const float dx = p.x - mouse.x;
            const float dy = p.y - mouse.y;
            if (dx * dx + dy * dy < nearestPx) {
                nearestPx = dx * dx + dy * dy;
                nearest = k * 3 + c;
            }
        }
        const ImU32 color = kChannelColors[static_cast<std::size_t>(c)];
        list.AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, 1.8f);
        for (const ImVec2& p : points) {
            list.AddCircleFilled(p, 2.2f, color, 8);
        }
        // R_P: a tick from the lower edge.
        const ImVec2 tick = axes.at(static_cast<float>(radius[c]), axes.bottomLog);
        list.AddLine({tick.x, tick.y - 12.0f}, tick, color, 2.0f);
    }
    int held = storage.GetInt(heldId, -1);
    if (!isActive) {
        held = isHovered ? nearest : -1;
    } else if (ImGui::IsItemActivated()) {
        held = nearest;
    }
    storage.SetInt(heldId, held);
    if (held >= 0 && held < static_cast<int>(profile.logProfile.size())) {
        const ImVec2 p = axes.at(spacing * static_cast<float>(held / 3),
                                 profile.logProfile[static_cast<std::size_t>(held)]);
        list.AddCircle(p, 5.5f, ImGui::GetColorU32(palette().text), 16, 1.5f);
    }
    list.PopClipRect();
    if (isHovered || isActive) {
        const int knot = held >= 0 ? held / 3 : -1;
        if (knot >= 0) {
            ImGui::SetTooltip(
                "r = %.3g mm\nP = %.3g /mm\xc2\xb2",
                static_cast<double>(spacing * static_cast<float>(knot)),
                std::exp(static_cast<double>(profile.logProfile[static_cast<std::size_t>(held)])));
        } else {
            ImGui::SetTooltip("Scattering profile P(r), 1/mm\xc2\xb2, on a logarithmic scale\n"
                              "Drag a knot; ticks below show the effective radii R_P");
        }
    }
    if (isActive && held >= 0 && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.5f)) {
        return KnotDrag{held % 3, held / 3, axes.logAt(mouse.y)};
    }
    return std::nullopt;
}

} // namespace celadon::ui
