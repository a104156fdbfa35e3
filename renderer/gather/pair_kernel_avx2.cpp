#include "renderer/gather/lanes_avx2.h"
#define CELADON_PAIR_FUNCTION addPairsAvx2
#include "renderer/gather/pair_kernel.inl"
