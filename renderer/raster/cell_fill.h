#pragma once

#include "renderer/raster/sample_cells.h"

/// One text (cell_fill.inl), compiled for each set of vector instructions.
namespace celadon {

void fillCellsPortable(const SampleCells& cells, SampleBand& band, const FilledTriangle& triangle);
void fillCellsAvx2(const SampleCells& cells, SampleBand& band, const FilledTriangle& triangle);

} // namespace celadon
