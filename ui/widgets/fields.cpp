#include "ui/widgets/fields.h"

#include "renderer/output/tone_map.h"
#include "ui/theme.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr float kLabelPart = 0.38f; ///< of the width

void label(const char* text, const char* help) {
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().label);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    tooltip(help);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * kLabelPart);
    ImGui::SetNextItemWidth(-1.0f);
}

} // namespace

void tooltip(const char* text) {
    if (text == nullptr || *text == '\0' ||
        !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        return;
    }
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const char* text) {
    ImGui::Spacing();
    ImGui::PushFont(font(Font::Heading));
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void hint(const char* text) {
    ImGui::PushFont(font(Font::Small));
    ImGui::PushStyleColor(ImGuiCol_Text, palette().muted);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

bool sliderField(const char* name, float& value, float least, float most, const char* format,
                 const char* help, bool logarithmic) {
    ImGui::PushID(name);
    label(name, help);
    const ImGuiSliderFlags flags =
        logarithmic ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat : 0;
    const bool changed = ImGui::SliderFloat("##value", &value, least, most, format, flags);
    tooltip(help);
    ImGui::PopID();
    if (changed) { // a number typed with Ctrl+click may lie anywhere
        value = std::clamp(value, least, most);
    }
    return changed;
}

bool sliderField(const char* name, int& value, int least, int most, const char* format,
                 const char* help) {
    ImGui::PushID(name);
    label(name, help);
    const bool changed = ImGui::SliderInt("##value", &value, least, most, format);
    tooltip(help);
    ImGui::PopID();
    if (changed) {
        value = std::clamp(value, least, most);
    }
    return changed;
}

bool textField(const char* name, std::string& text, const char* help) {
    static ImGuiID typedField = 0; // there is one at most
    static std::string typed;
    ImGui::PushID(name);
    label(name, help);
    const ImGuiID field = ImGui::GetID("##value");
    std::string shown = field == typedField ? typed : text;
    ImGui::InputText("##value", &shown, ImGuiInputTextFlags_AutoSelectAll);
    const bool isChanged = ImGui::IsItemDeactivatedAfterEdit() && shown != text;
    if (ImGui::IsItemActive()) {
        typedField = field;
        typed = shown;
    } else if (field == typedField) {
        typedField = 0;
    }
    tooltip(help);
    ImGui::PopID();
    if (isChanged) {
        text = shown;
    }
    return isChanged;
}

bool colorField(const char* name, float rgb[3], const char* help, bool isTint) {
    constexpr ImGuiColorEditFlags kPlain =
        ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
    static ImVec4 original; // of the one picker that is open
    ImGui::PushID(name);
    label(name, help);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetNextItemWidth(-ImGui::GetFrameHeight() - gap);
    bool isChanged = ImGui::DragFloat3("##value", rgb, 1.0f / 255.0f, 0.0f, 1.0f, "%.3f",
                                       ImGuiSliderFlags_AlwaysClamp);
    tooltip(help);
    ImGui::SameLine(0.0f, gap);
    float shown[4] = {encodeSrgb(rgb[0]), encodeSrgb(rgb[1]), encodeSrgb(rgb[2])};
    const ImVec4 now(shown[0], shown[1], shown[2], 1.0f);
    if (ImGui::ColorButton("##shown", now, kPlain)) {
        original = now;
        ImGui::OpenPopup("picker");
    }
    tooltip("The color as it looks: opens a picker, whose numbers are those of a screen (sRGB)");
    if (ImGui::BeginPopup("picker")) {
        if (ImGui::ColorPicker4("##picker", shown, kPlain | ImGuiColorEditFlags_NoAlpha,
                                &original.x)) {
            const float brightest = std::max({shown[0], shown[1], shown[2]});
            for (float& part : shown) {
                part = isTint ? part / std::max(brightest, 1e-6f) : part;
            }
            // It says so as long as it is held, and what it gives back is not quite the same.
            isChanged = std::max({std::abs(shown[0] - now.x), std::abs(shown[1] - now.y),
                                  std::abs(shown[2] - now.z)}) > 1e-3f;
            if (isChanged) {
                std::transform(shown, shown + 3, rgb, decodeSrgb);
            }
        }
        ImGui::EndPopup();
    }
    ImGui::PopID();
    const bool isBlack = std::max({rgb[0], rgb[1], rgb[2]}) <= 0.0f;
    return isChanged && !(isTint && isBlack);
}

int choiceRow(const char* id, const char* const* labels, const char* const* helps, int count,
              int current) {
    ImGui::PushID(id);
    int clicked = -1;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(count - 1)) /
                        static_cast<float>(count);
    for (int i = 0; i < count; ++i) {
        if (i > 0) {
            ImGui::SameLine(0.0f, gap);
        }
        const bool isCurrent = i == current;
        if (isCurrent) {
            ImGui::PushStyleColor(ImGuiCol_Button, palette().accentDim);
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, palette().accentDim);
        }
        if (ImGui::Button(labels[i], {width, 0.0f})) {
            clicked = i;
        }
        if (isCurrent) {
            ImGui::PopStyleColor(2);
        }
        tooltip(helps != nullptr ? helps[i] : nullptr);
    }
    ImGui::PopID();
    return clicked;
}

bool rowName(const char* label, bool isChosen, int buttons) {
    const float side = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = ImGui::GetContentRegionAvail().x - static_cast<float>(buttons) * side;
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.0f, 0.5f});
    ImGui::PushStyleColor(ImGuiCol_Button, isChosen ? palette().accentDim : ImVec4());
    const bool isClicked = ImGui::Button(label, {width, 0.0f});
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    return isClicked;
}

void sameRow() {
    ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
}

void readout(const char* name, const std::string& value, const char* help) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().label);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    tooltip(help);
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * kLabelPart);
    ImGui::TextUnformatted(value.c_str());
    tooltip(help);
}

} // namespace celadon::ui
