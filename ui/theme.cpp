#include "ui/theme.h"

#include <array>
#include <filesystem>
#include <string>

namespace celadon::ui {

namespace {

/// Latin, Greek, the signs of units, arrows and simple shapes.
constexpr std::array<ImWchar, 15> kRanges{0x0020, 0x00FF, 0x0391, 0x03C9, 0x2010,
                                          0x2027, 0x2070, 0x209C, 0x2190, 0x21FF,
                                          0x2200, 0x22FF, 0x25A0, 0x27BF, 0};
constexpr float kBodySize = 15.0f;

std::array<ImFont*, 4> gFonts{};

/// The first of the files that is there, else an empty name.
std::string firstPresent(std::initializer_list<const char*> files) {
    for (const char* file : files) {
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file, ignored)) {
            return file;
        }
    }
    return {};
}

ImFont* addFont(const std::string& file, float size) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFont* result = nullptr;
    if (!file.empty()) {
        result = atlas.AddFontFromFileTTF(file.c_str(), size, nullptr, kRanges.data());
    }
    if (result == nullptr) {
        ImFontConfig config;
        config.SizePixels = size;
        return atlas.AddFontDefault(&config);
    }
    // What the first font has no glyphs for: arrows, shapes, signs.
    const std::string more = firstPresent({"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"});
    if (!more.empty() && more != file) {
        ImFontConfig config;
        config.MergeMode = true;
        atlas.AddFontFromFileTTF(more.c_str(), size, &config, kRanges.data());
    }
    return result;
}

} // namespace

void loadFonts(float scale) {
    const std::string body =
        firstPresent({"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
                      "/usr/share/fonts/truetype/roboto/Roboto-Regular.ttf",
                      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"});
    const std::string heading =
        firstPresent({"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
                      "/usr/share/fonts/truetype/roboto/Roboto-Medium.ttf",
                      "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"});
    ImGui::GetIO().Fonts->Clear();
    gFonts[0] = addFont(body, kBodySize * scale);
    gFonts[1] = addFont(heading, kBodySize * scale);
    gFonts[2] = addFont(body, 13.0f * scale);
    gFonts[3] = gFonts[2];
    ImGui::GetIO().Fonts->Build();
}

ImFont* font(Font which) {
    return gFonts[static_cast<std::size_t>(which)];
}

void applyTheme(float scale) {
    ImGuiStyle style;
    style.WindowPadding = {12.0f, 12.0f};
    style.FramePadding = {8.0f, 4.0f};
    style.ItemSpacing = {8.0f, 7.0f};
    style.SelectableTextAlign = {0.0f, 0.5f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.IndentSpacing = 14.0f;
    style.ScrollbarSize = 10.0f;
    style.GrabMinSize = 10.0f;
    style.WindowRounding = 0.0f;
    style.ChildRounding = 4.0f;
    style.FrameRounding = 4.0f;
    style.PopupRounding = 6.0f;
    style.GrabRounding = 4.0f;
    style.TabRounding = 4.0f;
    style.ScrollbarRounding = 6.0f;
    style.WindowBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.FrameBorderSize = 0.0f;
    style.AntiAliasedLinesUseTex = true;

    ImVec4* c = style.Colors;
    const auto gray = [](float v, float a = 1.0f) {
        return ImVec4(0.97f * v, 1.0f * v, 1.0f * v, a);
    };
    const auto accent = [](float a) {
        return ImVec4(colors::kAccent.x, colors::kAccent.y, colors::kAccent.z, a);
    };
    c[ImGuiCol_Text] = colors::kText;
    c[ImGuiCol_TextDisabled] = colors::kMuted;
    c[ImGuiCol_WindowBg] = colors::kPanel;
    c[ImGuiCol_ChildBg] = gray(0.0f, 0.0f);
    c[ImGuiCol_PopupBg] = gray(0.13f);
    c[ImGuiCol_Border] = gray(0.22f);
    c[ImGuiCol_BorderShadow] = gray(0.0f, 0.0f);
    c[ImGuiCol_FrameBg] = gray(0.17f);
    c[ImGuiCol_FrameBgHovered] = gray(0.21f);
    c[ImGuiCol_FrameBgActive] = gray(0.24f);
    c[ImGuiCol_TitleBg] = gray(0.10f);
    c[ImGuiCol_TitleBgActive] = gray(0.13f);
    c[ImGuiCol_TitleBgCollapsed] = gray(0.10f);
    c[ImGuiCol_MenuBarBg] = gray(0.085f);
    c[ImGuiCol_ScrollbarBg] = gray(0.0f, 0.0f);
    c[ImGuiCol_ScrollbarGrab] = gray(0.26f);
    c[ImGuiCol_ScrollbarGrabHovered] = gray(0.32f);
    c[ImGuiCol_ScrollbarGrabActive] = gray(0.38f);
    c[ImGuiCol_CheckMark] = colors::kAccent;
    c[ImGuiCol_SliderGrab] = accent(0.40f);
    c[ImGuiCol_SliderGrabActive] = accent(0.65f);
    c[ImGuiCol_Button] = gray(0.20f);
    c[ImGuiCol_ButtonHovered] = gray(0.26f);
    c[ImGuiCol_ButtonActive] = accent(0.45f);
    c[ImGuiCol_Header] = accent(0.22f);
    c[ImGuiCol_HeaderHovered] = accent(0.30f);
    c[ImGuiCol_HeaderActive] = accent(0.40f);
    c[ImGuiCol_Separator] = gray(0.19f);
    c[ImGuiCol_SeparatorHovered] = accent(0.5f);
    c[ImGuiCol_SeparatorActive] = colors::kAccent;
    c[ImGuiCol_ResizeGrip] = gray(0.25f);
    c[ImGuiCol_ResizeGripHovered] = accent(0.5f);
    c[ImGuiCol_ResizeGripActive] = colors::kAccent;
    c[ImGuiCol_Tab] = gray(0.13f);
    c[ImGuiCol_TabHovered] = accent(0.35f);
    c[ImGuiCol_TabActive] = accent(0.28f);
    c[ImGuiCol_TabUnfocused] = gray(0.13f);
    c[ImGuiCol_TabUnfocusedActive] = accent(0.28f);
    c[ImGuiCol_PlotLines] = colors::kAccent;
    c[ImGuiCol_PlotLinesHovered] = colors::kText;
    c[ImGuiCol_PlotHistogram] = colors::kAccent;
    c[ImGuiCol_PlotHistogramHovered] = colors::kText;
    c[ImGuiCol_TableHeaderBg] = gray(0.15f);
    c[ImGuiCol_TableBorderStrong] = gray(0.22f);
    c[ImGuiCol_TableBorderLight] = gray(0.18f);
    c[ImGuiCol_TextSelectedBg] = accent(0.35f);
    c[ImGuiCol_DragDropTarget] = colors::kAccent;
    c[ImGuiCol_NavHighlight] = accent(0.8f);
    c[ImGuiCol_ModalWindowDimBg] = gray(0.0f, 0.55f);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

} // namespace celadon::ui
