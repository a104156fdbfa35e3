#pragma once

#include "ui/preferences.h"
#include "ui/session.h"
#include "ui/viewport.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// The frame around the viewport: menu bar, side bar with its tabs, status bar, notices.
namespace celadon::ui {

enum class Tab { Brush, Profile, Materials, Light, Deform, View };
/// @throws UsageError
[[nodiscard]] Tab parseTab(std::string_view word);

/// What the layout asks the editor for; everything else is a command.
struct LayoutActions {
    std::function<void()> openModel, openMaterial, openEnvironment;
    std::function<void()> save, saveAs, savePicture, quit;
    std::function<void()> openDeformers, saveDeformers;
    std::function<void()> preferencesChanged;
    std::function<void(const std::string&)> open;  ///< a recent file or builtin
    std::function<void(const std::string&)> putOn; ///< a material, by name or file
    std::function<void()> toggleFullScreen;
};

struct LayoutState {
    bool panelsShown = true;
    bool helpShown = false;
    bool preferencesShown = false;
    Tab tab = Tab::Brush;
    std::optional<double> scrollTo; ///< of the side bar, once
    std::string activity;           ///< what is being waited for, in the status bar
};

/// Where the viewport is, given what is shown.
[[nodiscard]] ViewportRect viewportRect(glm::ivec2 windowPx, const LayoutState& state, float scale);

void drawLayout(Session& session, LayoutState& state, Preferences& preferences,
                const LayoutActions& actions, const Viewport& viewport, float scale);

} // namespace celadon::ui
