#pragma once

#include "subedit/map/material_bake.h"

namespace celadon::subedit {

/// Cloudy green nephrite with pale clouds and dark veins, after the jade of Chen et al. 2012,
/// Table 1 (R_P 0.10 to 0.20 of the bounding sphere's radius). Not measured.
[[nodiscard]] MaterialMap bakeJade(int size, const BakeSettings& settings);

} // namespace celadon::subedit
