#include "ui/panels/material_panel.h"

#include "ui/length_text.h"
#include "ui/material_library.h"
#include "ui/theme.h"
#include "ui/user_folders.h"
#include "ui/widgets/fields.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdint>

namespace celadon::ui {

namespace {

/// As much of a label as there is room for.
std::string shortened(const std::string& label, float room) {
    if (ImGui::CalcTextSize(label.c_str()).x <= room) {
        return label;
    }
    constexpr const char* kMore = "\xe2\x80\xa6";
    std::string text = label;
    while (!text.empty() && ImGui::CalcTextSize((text + kMore).c_str()).x > room) {
        do {
            text.pop_back();
        } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80);
    }
    while (!text.empty() && text.back() == ' ') {
        text.pop_back();
    }
    return text + kMore;
}

void drawCurrent(Session& session) {
    const subedit::Document* const document = session.activeDocument();
    if (document == nullptr) {
        return;
    }
    const subedit::MaterialMap& map = document->material();
    heading(map.name.empty() ? "Material" : materialLabel(map.name).c_str());
    if (session.materialCount() > 1) {
        for (int i = 0; i < session.materialCount(); ++i) {
            const subedit::Document* const other = session.document(i);
            const std::string label =
                fmt::format("{} {}{}###{}", i + 1,
                            other != nullptr ? materialLabel(other->material().name) : "",
                            session.isModified(i) ? " (not saved)" : "", i);
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

/// What a radius in mm means depends on it.
void drawSize(Session& session) {
    std::string text = lengthText(2.0 * session.world().scatteringSphere.radius);
    if (!textField(
            "Model across", text,
            "Diameter in mm of the sphere about the model; cm, m and in are understood. Light "
            "reaches as far as the material says: a smaller model is more translucent. Steps "
            "before a change of size can no longer be undone. Export glTF keeps it")) {
        return;
    }
    if (const std::optional<double> mm = parseLengthMm(text)) {
        session.perform({"scene.size", {{"diameter", *mm}}});
    } else {
        session.notify(Notice::Kind::Warning,
                       "'" + text + "' is no length, such as 40, 2.5 cm or 0.3 m");
    }
}

void drawSaving(const LayoutContext& context) {
    if (context.session.activeDocument() == nullptr) {
        return;
    }
    std::string& name = context.state.newName;
    const float button = 92.0f * context.scale;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - gap);
    const bool isEntered = ImGui::InputTextWithHint("##new", "Name of a new material", &name,
                                                    ImGuiInputTextFlags_EnterReturnsTrue);
    tooltip("Keeps what is painted among your own materials, below");
    ImGui::SameLine(0.0f, gap);
    const bool hasSlash = name.find('/') != std::string::npos;
    const bool isName = !name.empty() && !hasSlash;
    ImGui::BeginDisabled(!isName);
    if ((ImGui::Button("Save as new", {button, 0.0f}) || isEntered) && isName) {
        context.actions.saveAsNew(name);
        name.clear();
    }
    ImGui::EndDisabled();
    tooltip(hasSlash       ? "A name without '/': it becomes that of a file"
            : name.empty() ? "Give it a name first"
                           : (dataFolder() / "materials").c_str());
}

/// The folders are read again now and then, as others may write there.
const MaterialLibrary& currentLibrary(const LayoutContext& context) {
    constexpr double kSeconds = 2.0;
    LayoutState& state = context.state;
    if (ImGui::GetTime() > state.libraryReadAt + kSeconds) {
        state.libraryReadAt = ImGui::GetTime();
        state.library =
            findMaterials(dataFolder() / "materials", context.preferences.recentMaterials);
        context.thumbnails.refresh();
    }
    return state.library;
}

void drawCard(const LayoutContext& context, const LibraryMaterial& material, float side) {
    ImGui::PushID(material.file.c_str());
    ImGui::BeginGroup();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##card", {side, side});
    const bool isHovered = ImGui::IsItemHovered();
    if (ImGui::IsItemClicked()) {
        context.session.perform(
            {"profile.medium", {{"which", "primary"}, {"name", material.nameOrPath}}});
    }
    if (isHovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        context.actions.putOn(material.nameOrPath);
    }
    tooltip(fmt::format("{}\nClick: into the hand. Double click: on the whole model\n{}",
                        material.label, material.file.string())
                .c_str());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(at.x + side, at.y + side);
    const float rounding = ImGui::GetStyle().FrameRounding;
    if (const gl::Texture* const picture = context.thumbnails.find(material.file)) {
        list.AddImageRounded(
            reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture->id())), at, end,
            {0.0f, 1.0f}, {1.0f, 0.0f}, IM_COL32_WHITE, rounding);
    } else {
        list.AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
    }
    if (isHovered) {
        list.AddRect(at, end, ImGui::GetColorU32(palette().accent), rounding, 0, 1.5f);
    }
    ImGui::PushFont(font(Font::Small));
    const ImVec2 text = ImGui::GetCursorScreenPos();
    list.AddText({text.x + 1.0f, text.y - 2.0f}, ImGui::GetColorU32(palette().text),
                 shortened(material.label, side).c_str());
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
    ImGui::PopFont();
    ImGui::EndGroup();
    ImGui::PopID();
}

void drawCards(const LayoutContext& context, const char* title,
               const std::vector<LibraryMaterial>& materials) {
    if (materials.empty()) {
        return;
    }
    heading(title);
    constexpr int kColumns = 3;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float side =
        std::max(24.0f, (ImGui::GetContentRegionAvail().x - gap * (kColumns - 1)) / kColumns);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        if (i % kColumns != 0) {
            ImGui::SameLine(0.0f, gap);
        }
        drawCard(context, materials[i], side);
    }
}

} // namespace

void drawMaterialPanel(const LayoutContext& context) {
    drawCurrent(context.session);
    drawSize(context.session);
    drawSaving(context);
    ImGui::Spacing();
    hint("Click: into the hand as primary profile. Double click: onto the whole model.");
    const MaterialLibrary& library = currentLibrary(context);
    drawCards(context, "Yours", library.own);
    drawCards(context, "Shipped", library.shipped);
    drawCards(context, "Used lately", library.recent);
}

} // namespace celadon::ui
