#pragma once

#include "subedit/map/material_bake.h"

namespace celadon::subedit {

/// Squares of light and dark marble with sharp borders, after the marble chessboard of Chen et al.
/// 2012, Table 1 (R_P 0.06 to 0.25 of the bounding sphere's radius). 16 x 16 squares.
[[nodiscard]] MaterialMap bakeMarbleChessboard(int size, const BakeSettings& settings);

/// White marble with gray veins.
[[nodiscard]] MaterialMap bakeVeinedMarble(int size, const BakeSettings& settings);

/// Pressed grains of different minerals in a pale binder, after their artificial stone (0.15 to
/// 0.30).
[[nodiscard]] MaterialMap bakeArtificialStone(int size, const BakeSettings& settings);

} // namespace celadon::subedit
