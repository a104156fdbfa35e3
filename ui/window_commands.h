#pragma once

#include "ui/background_jobs.h"
#include "ui/file_actions.h"
#include "ui/layout_state.h"
#include "ui/session.h"
#include "ui/viewport.h"
#include "ui/viewport_tools.h"

#include <functional>

/// Commands that need the window: what it shows, and what is written of its pictures.
namespace celadon::ui {

/// What they work on; outlives the session's dispatcher.
struct WindowTargets {
    LayoutState& layout;
    FileActions& files;
    ViewportTools& tools;
    Viewport& viewport;
    BackgroundJobs& jobs;
    std::function<void(Action)> act; ///< as if its key were pressed
};

void addWindowCommands(Session& session, const WindowTargets& targets);

} // namespace celadon::ui
