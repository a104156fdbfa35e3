#pragma once

#include "ui/surface_picker.h"
#include "ui/viewport.h"

struct ImDrawList;

/// What is drawn over the picture: the brush on the surface, lights, control points and handles,
/// scribbles, the line of a gradient, where copies come from.
namespace celadon::ui {

/// @param brushAt window pixels; nothing where the cursor is elsewhere
void drawViewportOverlay(ImDrawList& list, const Session& session, SurfacePicker& picker,
                         std::optional<glm::dvec2> brushAt, const ViewportRect& rect, float scale);

} // namespace celadon::ui
