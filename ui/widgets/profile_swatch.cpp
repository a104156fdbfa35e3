#include "ui/widgets/profile_swatch.h"

#include "renderer/output/tone_map.h"
#include "subedit/effective_radius.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

namespace celadon::ui {

namespace {

std::string describe(const NamedProfile& profile) {
    const glm::dvec3 albedo = subedit::diffuseAlbedo(profile.profile.view());
    const glm::dvec3 radius = subedit::effectiveRadiusMm(profile.profile.view(), 0.95);
    return fmt::format(
        "{}\nDiffuse albedo {:.2f} {:.2f} {:.2f}\nEffective radius {:.2g} {:.2g} {:.2g} mm",
        profile.name, albedo.r, albedo.g, albedo.b, radius.r, radius.g, radius.b);
}

} // namespace

unsigned albedoColor(const subedit::StoredProfile& profile) {
    const glm::dvec3 albedo = subedit::diffuseAlbedo(profile.view());
    return ImGui::ColorConvertFloat4ToU32({encodeSrgb(float(albedo.r)), encodeSrgb(float(albedo.g)),
                                           encodeSrgb(float(albedo.b)), 1.0f});
}

void drawProfilePair(Session& session) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float swap = ImGui::GetFrameHeight() * 1.4f;
    const float width = (ImGui::GetContentRegionAvail().x - swap - 2.0f * gap) / 2.0f;
    const float height = ImGui::GetFrameHeight() * 1.9f;
    const auto swatch = [&](const NamedProfile& profile, const char* id, bool isPrimary) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::InvisibleButton(id, {width, height});
        tooltip(describe(profile).c_str());
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 end(at.x + width, at.y + height);
        const float rounding = ImGui::GetStyle().FrameRounding;
        list.AddRectFilled(at, end, albedoColor(profile.profile), rounding);
        // The name on a strip of its own, whatever the color.
        const float strip = ImGui::GetFontSize() * 1.15f;
        list.AddRectFilled({at.x, end.y - strip}, end, IM_COL32(16, 18, 19, 215), rounding,
                           ImDrawFlags_RoundCornersBottom);
        ImGui::PushFont(font(Font::Small));
        list.PushClipRect(at, end, true);
        list.AddText({at.x + 5.0f, end.y - strip}, IM_COL32(225, 230, 228, 255),
                     profile.name.c_str());
        list.PopClipRect();
        ImGui::PopFont();
        if (isPrimary) {
            list.AddRect(at, end, ImGui::GetColorU32(palette().accent), rounding, 0, 1.5f);
        }
    };
    swatch(session.paint.primary, "##primary", true);
    ImGui::SameLine(0.0f, gap);
    if (ImGui::Button("\xe2\x87\x84", {swap, height})) {
        session.perform({"profile.swap"});
    }
    tooltip("Swaps primary and secondary (X)");
    ImGui::SameLine(0.0f, gap);
    swatch(session.paint.secondary, "##secondary", false);
}

} // namespace celadon::ui
