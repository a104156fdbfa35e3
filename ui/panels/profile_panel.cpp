#include "ui/panels/profile_panel.h"

#include "renderer/output/tone_map.h"
#include "subedit/effective_radius.h"
#include "subedit/exchange/subsurface_parameters.h"
#include "subedit/map/shipped_materials.h"
#include "subedit/presets.h"
#include "ui/model_profile.h"
#include "ui/slab_preview.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/held_change.h"
#include "ui/widgets/profile_plot.h"
#include "ui/widgets/profile_swatch.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

namespace celadon::ui {

namespace {

constexpr std::array<const char*, 3> kChannels{"Red", "Green", "Blue"};

void drawCurves(Session& session) {
    const float height = 190.0f * ImGui::GetFontSize() / 15.0f;
    if (const auto drag = drawProfilePlot(session.paint.primary.profile, height)) {
        performHeld(session, {"profile.knot",
                              {{"which", "primary"},
                               {"channel", drag->channel},
                               {"knot", drag->knot},
                               {"log", std::clamp(drag->logValue, -30.0f, 10.0f)}}});
    }
}

void drawNumbers(Session& session) {
    const subedit::ProfileView view = session.paint.primary.profile.view();
    const glm::dvec3 albedo = subedit::diffuseAlbedo(view);
    const glm::dvec3 radius = subedit::effectiveRadiusMm(view, 0.95);
    heading("Diffuse albedo A");
    for (int c = 0; c < 3; ++c) {
        float value = static_cast<float>(albedo[c]);
        if (sliderField(kChannels[static_cast<std::size_t>(c)], value, 0.001f, 0.999f, "%.3f",
                        "Part of the light that comes out again: 2\xcf\x80 \xe2\x88\xab P r dr")) {
            glm::dvec3 wanted = albedo;
            wanted[c] = static_cast<double>(value);
            performHeld(session,
                        {"profile.change", {{"which", "primary"}, {"albedo", toJson(wanted)}}});
        }
    }
    heading("Effective radius R_P");
    for (int c = 0; c < 3; ++c) {
        ImGui::PushID(3 + c);
        float value = static_cast<float>(radius[c]);
        const float most = std::max(40.0f, session.paint.primary.profile.maxRadiusMm);
        if (sliderField(kChannels[static_cast<std::size_t>(c)], value, 0.05f, most, "%.2f mm",
                        "Radius in mm that holds 95 % of the scattered energy", true)) {
            glm::dvec3 wanted = radius;
            wanted[c] = static_cast<double>(value);
            performHeld(session,
                        {"profile.change", {{"which", "primary"}, {"radius", toJson(wanted)}}});
        }
        ImGui::PopID();
    }
    glm::dvec3 length;
    for (int c = 0; c < 3; ++c) {
        length[c] =
            albedo[c] > 1e-4 && radius[c] > 0.0
                ? subedit::meanFreePathFromEffectiveRadius(std::min(albedo[c], 0.999), radius[c])
                : 0.0;
    }
    readout("Mean free path",
            fmt::format("{:.2g}, {:.2g}, {:.2g} mm", length.x, length.y, length.z),
            "\xe2\x84\x93 = 1/\xcf\x83t\xe2\x80\xb2 in mm, red, green, blue: of the normalized "
            "diffusion "
            "profile with this albedo and R_P (Christensen, Burley 2015)");
    readout("Ends at r_s", fmt::format("{:.3g} mm", session.paint.primary.profile.maxRadiusMm),
            "Maximum scattering radius: where the stored profile ends");
}

void drawPreview(const Session& session) {
    heading("A plate of it");
    static float thicknessMm = 10.0f; // of the preview only: no part of the document
    sliderField("Thickness", thicknessMm, 0.5f, 100.0f, "%.1f mm",
                "Of a plate that is lit evenly, from the front and from behind", true);
    const SlabLook look = lookOfSlab(session.paint.primary.profile, thicknessMm);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2.0f;
    const float height = ImGui::GetFrameHeight() * 1.8f;
    const auto swatch = [&](const glm::vec3& color, const char* label, const char* help) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::InvisibleButton(label, {width, height});
        tooltip(help);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 end(at.x + width, at.y + height);
        list.AddRectFilled(at, end,
                           ImGui::ColorConvertFloat4ToU32({encodeSrgb(color.r), encodeSrgb(color.g),
                                                           encodeSrgb(color.b), 1.0f}),
                           4.0f);
        ImGui::PushFont(font(Font::Small));
        const bool isLight = color.g > 0.25f;
        list.AddText({at.x + 6.0f, end.y - ImGui::GetFontSize() - 3.0f},
                     isLight ? IM_COL32(20, 22, 22, 230) : IM_COL32(225, 230, 228, 230), label);
        ImGui::PopFont();
    };
    swatch(look.reflected, "From the front", "Light that comes back");
    ImGui::SameLine(0.0f, gap);
    swatch(glm::min(4.0f * look.transmitted, glm::vec3(1.0f)), "From behind",
           "Light that comes through, shown two stops brighter");
    hint("Estimated from albedo and the fall of P(r) (Kubelka 1948).");
}

void drawStarts(Session& session) {
    heading("Start from");
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##start", "Measured medium or material\xe2\x80\xa6")) {
        for (const std::string& name : subedit::shippedMaterialNames()) {
            if (ImGui::Selectable(name.c_str())) {
                session.perform({"profile.medium", {{"which", "primary"}, {"name", name}}});
            }
        }
        ImGui::EndCombo();
    }
    tooltip("Homogeneous ones are measured media (Jensen et al. 2001); of the others the middle is "
            "taken");
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##model", "The same light by a model\xe2\x80\xa6")) {
        for (const ModelName& model : profileModels()) {
            if (ImGui::Selectable(model.label)) {
                const subedit::ProfileView view = session.paint.primary.profile.view();
                session.perform({"profile.model",
                                 {{"which", "primary"},
                                  {"model", model.word},
                                  {"name", session.paint.primary.name},
                                  {"albedo", toJson(subedit::diffuseAlbedo(view))},
                                  {"radius", toJson(subedit::effectiveRadiusMm(view, 0.95))}}});
            }
            tooltip(model.help);
        }
        ImGui::EndCombo();
    }
    tooltip("Albedo and R_P as they are, the shape by a published model");
}

} // namespace

void drawProfilePanel(Session& session) {
    heading(session.paint.primary.name.c_str());
    drawCurves(session);
    drawProfilePair(session);
    drawNumbers(session);
    drawPreview(session);
    drawStarts(session);
}

} // namespace celadon::ui
