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

Palette paletteOf(Theme theme) {
    switch (theme) {
    case Theme::Gray: // what colors are judged against
        return {{0.62f, 0.84f, 0.72f, 1.0f},   {0.33f, 0.50f, 0.42f, 1.0f},
                {0.94f, 0.95f, 0.95f, 1.0f},   {0.80f, 0.82f, 0.81f, 1.0f},
                {0.66f, 0.68f, 0.67f, 1.0f},   {0.97f, 0.80f, 0.48f, 1.0f},
                {1.00f, 0.62f, 0.57f, 1.0f},   {0.23f, 0.236f, 0.238f, 1.0f},
                {0.16f, 0.165f, 0.168f, 1.0f}, {1.0f, 1.0f, 1.0f, 0.09f}};
    case Theme::Light:
        return {{0.13f, 0.46f, 0.33f, 1.0f},   {0.60f, 0.79f, 0.69f, 1.0f},
                {0.11f, 0.12f, 0.12f, 1.0f},   {0.25f, 0.27f, 0.26f, 1.0f},
                {0.38f, 0.41f, 0.40f, 1.0f},   {0.56f, 0.35f, 0.02f, 1.0f},
                {0.71f, 0.13f, 0.10f, 1.0f},   {0.86f, 0.868f, 0.866f, 1.0f},
                {0.95f, 0.955f, 0.953f, 1.0f}, {0.0f, 0.0f, 0.0f, 0.10f}};
    case Theme::Dark:
        break;
    }
    return {{0.56f, 0.78f, 0.66f, 1.0f},    {0.30f, 0.45f, 0.38f, 1.0f},
            {0.88f, 0.90f, 0.89f, 1.0f},    {0.70f, 0.73f, 0.72f, 1.0f},
            {0.55f, 0.58f, 0.57f, 1.0f},    {0.93f, 0.74f, 0.40f, 1.0f},
            {0.94f, 0.48f, 0.43f, 1.0f},    {0.105f, 0.113f, 0.117f, 1.0f},
            {0.075f, 0.082f, 0.086f, 1.0f}, {1.0f, 1.0f, 1.0f, 0.07f}};
}

Palette gPalette = paletteOf(Theme::Dark);

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

const Palette& palette() {
    return gPalette;
}

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

void applyTheme(Theme theme, float scale) {
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

    gPalette = paletteOf(theme);
    ImVec4* c = style.Colors;
    // Grays of the dark theme, and what stands for them in the others.
    const auto gray = [theme](float v, float a = 1.0f) {
        const float w = theme == Theme::Dark
                            ? v
                            : (theme == Theme::Gray ? 0.12f + 1.05f * v : 0.97f - 1.05f * v);
        return ImVec4(0.97f * w, 1.0f * w, 1.0f * w, a);
    };
    const auto accent = [](float a) {
        return ImVec4(palette().accent.x, palette().accent.y, palette().accent.z, a);
    };
    c[ImGuiCol_Text] = palette().text;
    c[ImGuiCol_TextDisabled] = palette().muted;
    c[ImGuiCol_WindowBg] = palette().panel;
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
    c[ImGuiCol_CheckMark] = palette().accent;
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
    c[ImGuiCol_SeparatorActive] = palette().accent;
    c[ImGuiCol_ResizeGrip] = gray(0.25f);
    c[ImGuiCol_ResizeGripHovered] = accent(0.5f);
    c[ImGuiCol_ResizeGripActive] = palette().accent;
    c[ImGuiCol_Tab] = gray(0.13f);
    c[ImGuiCol_TabHovered] = accent(0.35f);
    c[ImGuiCol_TabActive] = accent(0.28f);
    c[ImGuiCol_TabUnfocused] = gray(0.13f);
    c[ImGuiCol_TabUnfocusedActive] = accent(0.28f);
    c[ImGuiCol_PlotLines] = palette().accent;
    c[ImGuiCol_PlotLinesHovered] = palette().text;
    c[ImGuiCol_PlotHistogram] = palette().accent;
    c[ImGuiCol_PlotHistogramHovered] = palette().text;
    c[ImGuiCol_TableHeaderBg] = gray(0.15f);
    c[ImGuiCol_TableBorderStrong] = gray(0.22f);
    c[ImGuiCol_TableBorderLight] = gray(0.18f);
    c[ImGuiCol_TextSelectedBg] = accent(0.35f);
    c[ImGuiCol_DragDropTarget] = palette().accent;
    c[ImGuiCol_NavHighlight] = accent(0.8f);
    c[ImGuiCol_ModalWindowDimBg] = ImVec4(0.0f, 0.0f, 0.0f, 0.55f);
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

} // namespace celadon::ui
