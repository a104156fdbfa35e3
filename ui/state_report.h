#pragma once

#include "ui/file_actions.h"
#include "ui/script.h"
#include "ui/session.h"
#include "ui/viewport.h"

#include <nlohmann/json.hpp>

/// What `--state` writes for scripts that wait: which scene, what is under way, what was done.
namespace celadon::ui {

struct StateSources {
    const Session& session;
    const Viewport& viewport;
    const FileActions& files;
    const Script& script;
    bool isOpening;
    bool isSettled; ///< the picture on screen is final
};

[[nodiscard]] nlohmann::json reportState(const StateSources& sources);

} // namespace celadon::ui
