#pragma once

#include "ui/key_map.h"
#include "ui/layout_state.h"

/// What each shortcut does: most are commands, some concern the window only.
namespace celadon::ui {

struct KeyTargets {
    Session& session;
    ViewportTools& tools;
    const ViewportRect& viewport;
    LayoutState& layout;
    const LayoutActions& actions;
    const KeyMap& keys;
};

void performAction(Action action, const KeyTargets& targets);

} // namespace celadon::ui
