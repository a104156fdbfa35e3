#pragma once

#include <imgui.h>

/// How the editor looks: calm, dark, one accent; fonts of the system where they are.
namespace celadon::ui {

namespace colors {
inline const ImVec4 kAccent{0.56f, 0.78f, 0.66f, 1.0f}; ///< celadon
inline const ImVec4 kAccentDim{0.30f, 0.45f, 0.38f, 1.0f};
inline const ImVec4 kText{0.88f, 0.90f, 0.89f, 1.0f};
inline const ImVec4 kMuted{0.55f, 0.58f, 0.57f, 1.0f};
inline const ImVec4 kWarning{0.93f, 0.74f, 0.40f, 1.0f};
inline const ImVec4 kError{0.94f, 0.48f, 0.43f, 1.0f};
inline const ImVec4 kPanel{0.105f, 0.113f, 0.117f, 1.0f};
} // namespace colors

/// A part of the frame around the viewport: it has its place.
inline constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

enum class Font { Body, Heading, Small, Mono };

/// Rebuilds the font atlas; the GL texture is the caller's. Roboto, else DejaVu Sans, else ImGui's.
void loadFonts(float scale);
[[nodiscard]] ImFont* font(Font which);

void applyTheme(float scale);

} // namespace celadon::ui
