#pragma once

#include "app/command.h"
#include "app/render_options.h"

namespace celadon::app {

/// `celadon render MODEL -o OUT`: stills and sequences.
[[nodiscard]] Command addRenderCommand(CLI::App& root);

/// @param options validated @throws celadon::Error
void render(const RenderOptions& options);

} // namespace celadon::app
