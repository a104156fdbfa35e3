#pragma once

#include "subedit/map/material_bake.h"

namespace celadon::subedit {

/// Banded onyx: layers of clear and milky stone, honey to white, folded as sediments are. Not
/// measured.
[[nodiscard]] MaterialMap bakeBandedOnyx(int size, const BakeSettings& settings);

} // namespace celadon::subedit
