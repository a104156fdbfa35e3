#pragma once

/// Functions compiled twice, for AVX2 and for any x86-64, and chosen when the program starts. No
/// fused multiply-add is enabled: both give the same bits. Off under sanitizers, which do not bear
/// the indirect functions that this is made of.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CELADON_MULTIVERSION __attribute__((target_clones("avx2", "default")))
#else
#define CELADON_MULTIVERSION
#endif

namespace celadon::subedit {

/// Floats side by side, for loops in such functions that the compiler does not turn into vector
/// code by itself. GCC and Clang alike.
using Eight = float __attribute__((vector_size(32)));

/// Lanes of an Eight in another order, the indices of which need not be known before.
#if defined(__clang__)
#define CELADON_CHOOSE(values, places)                                                             \
    [&] {                                                                                          \
        Eight chosen;                                                                              \
        for (int lane = 0; lane < 8; ++lane) {                                                     \
            chosen[lane] = (values)[(places)[lane]];                                               \
        }                                                                                          \
        return chosen;                                                                             \
    }()
#else
#define CELADON_CHOOSE(values, places) __builtin_shuffle(values, places)
#endif

} // namespace celadon::subedit
