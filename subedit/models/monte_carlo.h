#pragma once

#include "subedit/models/random_walk.h"
#include "subedit/radial_curve.h"

namespace celadon::subedit {

/// The profile that random walks found. Rings of too much noise (a standard error above a tenth)
/// are joined with their neighbors; between rings ln P is linear in ln r, and beyond the last it
/// goes on as an exponential. Infinite at r = 0.
[[nodiscard]] RadialCurves monteCarloProfile(const RandomWalkResult& result);

} // namespace celadon::subedit
