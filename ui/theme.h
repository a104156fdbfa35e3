#pragma once

#include "ui/preferences.h"

#include <imgui.h>

/// How the editor looks: calm, one accent; fonts of the system where they are.
namespace celadon::ui {

/// Beyond ImGui's own colors.
struct Palette {
    ImVec4 accent; ///< celadon
    ImVec4 accentDim;
    ImVec4 text;
    ImVec4 label; ///< of fields
    ImVec4 muted;
    ImVec4 warning;
    ImVec4 error;
    ImVec4 panel;
    ImVec4 well; ///< behind curves and graphs
    ImVec4 grid;
};
/// Of the theme that was applied last.
[[nodiscard]] const Palette& palette();

/// A part of the frame around the viewport: it has its place.
inline constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

enum class Font { Body, Heading, Small, Mono };

/// Rebuilds the font atlas; the GL texture is the caller's. Roboto, else DejaVu Sans, else ImGui's.
void loadFonts(float scale);
[[nodiscard]] ImFont* font(Font which);

void applyTheme(Theme theme, float scale);

} // namespace celadon::ui
