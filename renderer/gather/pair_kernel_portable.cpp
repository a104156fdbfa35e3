#include "renderer/gather/lanes_portable.h"
#define CELADON_PAIR_FUNCTION addPairsPortable
#include "renderer/gather/pair_kernel.inl"
