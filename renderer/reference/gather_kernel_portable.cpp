#define CELADON_GATHER_NAME gatherPortable
#include "renderer/reference/gather_kernel.inl"
