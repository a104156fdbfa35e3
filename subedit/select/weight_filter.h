#pragma once

#include "subedit/paint/surface.h"
#include "subedit/select/weight_mask.h"

/// Weights changed by what lies around them on the surface. Distances are in mm.
namespace celadon::subedit {

/// Each covered texel gets the largest weight within the distance. Soft edges move as they are; a
/// mask of nothing but 0 and 1 stays one.
[[nodiscard]] WeightMask growWeights(const Surface& surface, const WeightMask& mask,
                                     float distanceMm);

/// Edges become smooth ramps of twice the distance, centered on the edge. A soft mask is taken as a
/// stack of hard ones.
[[nodiscard]] WeightMask featherWeights(const Surface& surface, const WeightMask& mask,
                                        float distanceMm);

/// Background texels near a chart get the weight of the texel that they repeat, others none.
void repeatInGutters(const Surface& surface, WeightMask& mask);

} // namespace celadon::subedit
