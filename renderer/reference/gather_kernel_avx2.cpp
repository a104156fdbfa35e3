#define CELADON_GATHER_NAME gatherAvx2
#include "renderer/reference/gather_kernel.inl"
