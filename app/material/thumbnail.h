#pragma once

#include "renderer/output/image.h"
#include "subedit/map/material_map.h"

namespace celadon::app {

/// A small picture of a map, display-encoded R,G,B: left the albedo of its texels as a color, right
/// the effective radii (95 %) of the three channels as one, linear from 0 to the map's largest.
/// Each half is 256 pixels high and as wide as the map's shape asks for (64 to 1024).
[[nodiscard]] FloatImage drawThumbnail(const subedit::MaterialMap& map);

} // namespace celadon::app
