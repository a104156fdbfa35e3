#pragma once

#include "subedit/map/material_bake.h"

namespace celadon::subedit {

/// Beeswax with darker veins, after the yellow wax of Chen et al. 2012, Table 1 (R_P 0.12 to 0.30
/// of the bounding sphere's radius).
[[nodiscard]] MaterialMap bakeYellowWax(int size, const BakeSettings& settings);

/// Swirls of clear and dense blue wax, after their blue wax (0.08 to 0.35).
[[nodiscard]] MaterialMap bakeBlueWax(int size, const BakeSettings& settings);

} // namespace celadon::subedit
