#include "ui/panels/long_edit.h"

#include "ui/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr std::chrono::milliseconds kPatience{300}; ///< shorter edits are not worth a word
constexpr std::chrono::milliseconds kBetweenFrames{60};

} // namespace

bool LongEdit::tell(const std::string& title, float done) {
    const Clock::time_point now = Clock::now();
    if (!mBegin) {
        mBegin = now;
    }
    mTitle = title;
    if (!mTitle.empty()) {
        mTitle[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(mTitle[0])));
    }
    mDone = done;
    if (now - *mBegin < kPatience || (mDrawn && now - *mDrawn < kBetweenFrames)) {
        return false;
    }
    mDrawn = now;
    return true;
}

void LongEdit::finish() {
    mBegin.reset();
    mDrawn.reset();
    mIsGivenUp = false;
}

void LongEdit::draw(float scale) {
    if (!isShown()) {
        return;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    // Over everything: what lies below neither sees the cursor nor takes a click.
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(display);
    ImGui::SetNextWindowFocus();
    ImGui::SetNextWindowBgAlpha(0.4f);
    ImGui::Begin("##curtain", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::End();
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(360.0f * scale, 0.95f * display.x), 0.0f});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("##long edit", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextUnformatted((mTitle + " \xe2\x80\xa6").c_str());
    const float seconds = std::chrono::duration<float>(*mDrawn - *mBegin).count();
    if (mDone >= 0.0f) {
        ImGui::ProgressBar(mDone, {-1.0f, 0.0f});
    } else { // a part of the bar that goes to and fro
        const float phase = std::fmod(0.5f * seconds, 2.0f);
        const ImVec2 from = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        ImGui::ProgressBar(0.0f, {-1.0f, 0.0f}, "");
        const ImVec2 to{from.x + width, ImGui::GetItemRectMax().y};
        const float start = from.x + 0.75f * width * (phase < 1.0f ? phase : 2.0f - phase);
        ImGui::GetWindowDrawList()->AddRectFilled({start, from.y}, {start + 0.25f * width, to.y},
                                                  ImGui::GetColorU32(ImGuiCol_PlotHistogram),
                                                  ImGui::GetStyle().FrameRounding);
    }
    ImGui::Spacing();
    const bool isEscaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (ImGui::Button("Cancel", {-1.0f, 0.0f}) || isEscaped) {
        mIsGivenUp = true;
    } else if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Esc: gives the edit up, and leaves the material as it was");
    }
    ImGui::End();
}

} // namespace celadon::ui
