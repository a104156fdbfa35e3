#define CELADON_FILL_FUNCTION fillCellsPortable
#include "renderer/raster/cell_fill.inl"
