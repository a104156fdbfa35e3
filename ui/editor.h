#pragma once

#include "renderer/frame_quality.h"
#include "ui/session.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

/// The editor: one window on one session (DESIGN 5, `celadon edit`).
namespace celadon::ui {

struct EditorOptions {
    OpenRequest open;
    bool isFirstScene = false;           ///< nothing was named: the scene that Celadon greets with
    std::function<void(Session&)> place; ///< camera and lights of the command line, once open
    glm::ivec2 windowSize{1280, 720};
    double scale = 0.0; ///< of the interface; 0: what the preferences or the display say
    Quality finest = Quality::Final;
    std::optional<std::filesystem::path> record, replay, screenshot, state;
    std::vector<std::pair<int, std::filesystem::path>> screenshotsAt; ///< after the n-th command
    bool exitAfterReplay = false;
    bool viewOnly = false;
    bool watch = false;
    SessionServices services;
};

/// Opens the window and returns when it is closed.
/// @throws ContextError without a display; InputError for a replay that cannot be read or done
void runEditor(const EditorOptions& options);

} // namespace celadon::ui
