#include "ui/panels/question.h"

#include "ui/theme.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

namespace celadon::ui {

void Question::ask(const std::string& title, const std::string& text, std::vector<Answer> answers) {
    mTitle = title;
    mText = text;
    mAnswers = std::move(answers);
    mAppears = true;
}

void Question::draw(float scale) {
    if (mAnswers.empty()) {
        return;
    }
    const std::string id = mTitle + "##question";
    const bool isNew = std::exchange(mAppears, false);
    if (isNew) {
        ImGui::OpenPopup(id.c_str());
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(460.0f * scale, 0.95f * display.x), 0.0f});
    int chosen = -1;
    if (ImGui::BeginPopupModal(id.c_str(), nullptr,
                               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(mText.c_str());
        ImGui::PopTextWrapPos();
        ImGui::Spacing();
        const int count = static_cast<int>(mAnswers.size());
        const float gap = ImGui::GetStyle().ItemSpacing.x;
        const float width =
            (ImGui::GetContentRegionAvail().x - gap * static_cast<float>(count - 1)) /
            static_cast<float>(count);
        for (int i = 0; i < count; ++i) {
            if (i > 0) {
                ImGui::SameLine();
            }
            if (i == 0) {
                ImGui::PushStyleColor(ImGuiCol_Button, palette().accentDim);
            }
            if (ImGui::Button(mAnswers[static_cast<std::size_t>(i)].label.c_str(), {width, 0.0f})) {
                chosen = i;
            }
            if (i == 0) {
                ImGui::PopStyleColor();
            }
        }
        const auto isPressed = [isNew](ImGuiKey key) { // not by what led to the question
            return !isNew && ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false);
        };
        if (isPressed(ImGuiKey_Escape)) {
            chosen = count - 1;
        } else if (isPressed(ImGuiKey_Enter) || isPressed(ImGuiKey_KeyPadEnter)) {
            chosen = 0;
        }
        if (chosen >= 0) {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
    if (chosen >= 0) {
        const std::vector<Answer> answers = std::exchange(mAnswers, {});
        const auto& act = answers[static_cast<std::size_t>(chosen)].act;
        if (act) {
            act(); // which may ask again
        }
    }
}

} // namespace celadon::ui
