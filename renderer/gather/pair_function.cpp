#include "renderer/gather/pair_kernel.h"

namespace celadon::gather {

PairFunction choosePairFunction() {
#ifdef CELADON_GATHER_X86
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
        return addPairsAvx512;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        return addPairsAvx2;
    }
#endif
    return addPairsPortable;
}

} // namespace celadon::gather
