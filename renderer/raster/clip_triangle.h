#pragma once

#include "renderer/raster/screen_vertex.h"

#include <array>
#include <vector>

/// Triangles that reach behind the eye, through the near plane or far out of the picture.
namespace celadon {

/// Appends the parts of a triangle that lie within the limits, each of three vertices; nothing for
/// one that is outside or not finite. Clipped against the planes one after the other (Sutherland,
/// Hodgman 1974).
void clipTriangle(const std::array<glm::vec4, 3>& clip, const ClipLimits& limits,
                  std::vector<std::array<ScreenVertex, 3>>& parts);

} // namespace celadon
