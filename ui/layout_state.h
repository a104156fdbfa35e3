#pragma once

#include "ui/background_jobs.h"
#include "ui/material_library.h"
#include "ui/preferences.h"
#include "ui/session.h"
#include "ui/thumbnails.h"
#include "ui/truth_view.h"
#include "ui/viewport.h"
#include "ui/viewport_tools.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// What the frame around the viewport shows, and what it asks the editor for.
namespace celadon::ui {

enum class Tab { Brush, Profile, Materials, Light, Deform, View };
/// @throws UsageError
[[nodiscard]] Tab parseTab(std::string_view word);

/// What the panels ask the editor for; everything else is a command.
struct LayoutActions {
    std::function<void()> openModel, openMaterial, openEnvironment, openStamp;
    std::function<void()> openDeformers, saveDeformers;
    std::function<void()> save, saveAs, savePicture, exportGltf, quit;
    std::function<void(const std::string&)> saveAsNew; ///< a material of that name
    std::function<void(int frames)> saveTurntable;
    std::function<void()> togglePlay, toggleTurntable, cancelJobs;
    std::function<void(const std::string&)> open;  ///< a recent file or builtin
    std::function<void(const std::string&)> putOn; ///< a material, by name or file
    std::function<void()> toggleFullScreen;
};

struct LayoutState {
    bool panelsShown = true;
    bool helpShown = false;
    bool preferencesShown = false;
    std::optional<Action> keyWantedFor; ///< the preferences wait for a key
    bool hasPen = false;                ///< one that tells its pressure is connected
    Tab tab = Tab::Brush;
    std::optional<double> scrollTo; ///< of the side bar, once
    std::string openMenu;           ///< to be opened, once
    std::string activity;           ///< what is being waited for, in the status bar
    bool canCancel = false;         ///< that can be given up
    bool isRecovering = false;      ///< steps are replayed: nothing else may be done
    std::optional<BackgroundJobs::Running> job;
    bool isTurning = false;      ///< the turntable plays
    int turntableFrames = 72;    ///< of an exported turn
    std::string newName;         ///< of a material to be saved as new
    MaterialLibrary library;     ///< what the browser shows
    double libraryReadAt = -1e9; ///< ImGui's time, s
};

/// All that is drawn around the viewport reads these, and changes the state only.
struct LayoutContext {
    Session& session;
    LayoutState& state;
    Preferences& preferences;
    const LayoutActions& actions;
    Viewport& viewport;
    Thumbnails& thumbnails;
    const TruthView& truth;
    const ViewportTools& tools;
    float scale = 1.0f;
};

} // namespace celadon::ui
