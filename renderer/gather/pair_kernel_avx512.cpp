#include "renderer/gather/lanes_avx512.h"
#define CELADON_PAIR_FUNCTION addPairsAvx512
#include "renderer/gather/pair_kernel.inl"
