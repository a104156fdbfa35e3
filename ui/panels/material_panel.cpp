#include "ui/panels/material_panel.h"

#include "subedit/map/shipped_materials.h"
#include "ui/theme.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>

namespace celadon::ui {

namespace {

void drawCurrent(Session& session) {
    const subedit::Document* const document = session.activeDocument();
    if (document == nullptr) {
        return;
    }
    const subedit::MaterialMap& map = document->material();
    heading(map.name.empty() ? "Material" : map.name.c_str());
    if (session.materialCount() > 1) {
        for (int i = 0; i < session.materialCount(); ++i) {
            const subedit::Document* const other = session.document(i);
            const std::string label =
                fmt::format("{} {}", i + 1, other != nullptr ? other->material().name : "");
            if (ImGui::RadioButton(label.c_str(), session.activeMaterial == i)) {
                session.perform({"material.activate", {{"material", i}}});
            }
        }
    }
    readout("Map", fmt::format("{}\xc3\x97{} texels", map.width, map.height),
            "Texels of the material's map; each holds a scattering profile");
    readout("Profile", fmt::format("{} segments to {:.3g} mm", map.segments, map.maxRadiusMm),
            "Piecewise linear in ln P, up to the maximum scattering radius r_s");
    readout("Refraction", fmt::format("\xce\xb7 = {:.2f}", map.eta),
            "Relative index of refraction of the surface");
    readout("Texel", fmt::format("{:.2g} mm", document->surface().texelSizeMm()),
            "Median distance of neighboring texels on the surface, mm");
}

} // namespace

void drawMaterialPanel(Session& session, const std::function<void(const std::string&)>& putOn) {
    drawCurrent(session);
    heading("Shipped materials");
    hint("Click: into the hand as primary profile. Double click: onto the whole model.");
    for (const std::string& name : subedit::shippedMaterialNames()) {
        if (ImGui::Selectable(name.c_str(), false, ImGuiSelectableFlags_AllowDoubleClick)) {
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
                putOn(name);
            } else {
                session.perform({"profile.medium", {{"which", "primary"}, {"name", name}}});
            }
        }
    }
}

} // namespace celadon::ui
