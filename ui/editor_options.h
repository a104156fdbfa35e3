#pragma once

#include "renderer/frame_quality.h"
#include "ui/session.h"

#include <glm/vec2.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace celadon::ui {

/// How a long replay went, one point a command: what `--trace` keeps.
struct TracePoint {
    double seconds = 0.0;     ///< since the window opened
    double commandMs = 0.0;   ///< the map changed
    double pictureMs = 0.0;   ///< until the light of it was on screen
    double processorMs = 0.0; ///< of both, of all cores: what other programs do does not count
    double memoryMb = 0.0;    ///< resident
};

/// What `celadon edit` was asked for.
struct EditorOptions {
    OpenRequest open;
    OpenRequest greeting;                ///< the scene that Celadon greets with
    std::function<void(Session&)> place; ///< camera and lights of the command line, once open
    glm::ivec2 windowSize{1280, 720};
    double scale = 0.0; ///< of the interface; 0: what the preferences or the display say
    Quality finest = Quality::Final;
    std::optional<std::filesystem::path> record, replay, screenshot, state;
    std::vector<std::pair<int, std::filesystem::path>> screenshotsAt; ///< after the n-th command
    double repeatSeconds = 0.0; ///< the replay begins again until so much time has passed
    std::function<void(const TracePoint&)> trace; ///< each command then waits for its picture
    bool exitAfterReplay = false;
    bool viewOnly = false;
    bool watch = false;
    SessionServices services;
};

} // namespace celadon::ui
