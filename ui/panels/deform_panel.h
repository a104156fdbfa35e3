#pragma once

#include "ui/session.h"

#include <filesystem>
#include <functional>

/// What moves the model: playback, the list of deformers, amounts, control points, handles, keys.
namespace celadon::ui {

struct DeformActions {
    std::function<void()> open, save; ///< dialogs
};

void drawDeformPanel(Session& session, const DeformActions& actions);

/// Plays, or stops at the moment that is shown.
void togglePlay(Session& session);

/// Replaces the deformers by those of a file; what is wrong with it becomes a notice.
void openDeformers(Session& session, const std::filesystem::path& file);

} // namespace celadon::ui
