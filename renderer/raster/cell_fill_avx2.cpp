#define CELADON_FILL_FUNCTION fillCellsAvx2
#include "renderer/raster/cell_fill.inl"
