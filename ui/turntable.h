#pragma once

#include "ui/background_jobs.h"
#include "ui/session.h"

#include <filesystem>

/// The object turned once around, light and eye at rest: as a sequence of pictures.
namespace celadon::ui {

struct TurntableSettings {
    int frames = 72; ///< of a whole turn
    glm::ivec2 sizePx{1280, 720};
    std::filesystem::path file; ///< the number goes before the extension: turn.png, turn_0001.png
};

/// Renders in the background, at the quality "default"; a notice says when it is done.
/// @throws OutputError when nothing can be written there
void startTurntable(Session& session, BackgroundJobs& jobs, const TurntableSettings& settings);

} // namespace celadon::ui
