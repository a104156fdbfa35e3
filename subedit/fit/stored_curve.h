#pragma once

#include "subedit/map/material_map.h"
#include "subedit/radial_curve.h"

namespace celadon::subedit {

/// One texel of a material as a curve again: ln P linear on each segment, zero beyond r_s. Holds a
/// copy of the texel. @param x, y within the map
[[nodiscard]] RadialCurves storedCurves(const MaterialMap& map, int x = 0, int y = 0);

} // namespace celadon::subedit
