#pragma once

#include "ui/editor_options.h"

/// The editor: one window on one session (DESIGN 5, `celadon edit`).
namespace celadon::ui {

/// Opens the window and returns when it is closed.
/// @throws ContextError without a display; InputError for a replay that cannot be read or done
void runEditor(const EditorOptions& options);

} // namespace celadon::ui
