#pragma once

#include <cstdint>
#include <cstring>

/// Four numbers side by side: a pixel's, a color's, or one of each of four neighbors. GCC and Clang
/// alike; any x86-64 has such registers.
namespace celadon {

using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

inline Four four(float v) {
    return Four{v, v, v, v};
}
inline Four loadFour(const float* from) {
    Four v;
    std::memcpy(&v, from, sizeof(v));
    return v;
}
inline void storeFour(float* to, Four v) {
    std::memcpy(to, &v, sizeof(v));
}

inline Four smaller(Four a, Four b) {
    return a < b ? a : b;
}
inline Four larger(Four a, Four b) {
    return a > b ? a : b;
}
inline Four magnitude(Four v) {
    return larger(v, -v);
}
inline Four square(Four v) {
    return v * v;
}

/// Of the first three.
inline float dot3(Four a, Four b) {
    const Four product = a * b;
    return product[0] + product[1] + product[2];
}

/// e^x for four lanes at once; subedit/fast_exp.h is for loops over many. NaN becomes e^-87.
/// Relative error 3e-6 near 0, less than 2e-5 anywhere (Taylor series of 2^f, f in
/// [-1/2, 1/2]); e^-87 below that, e^87 above.
inline Four exponential(Four x) {
    constexpr float kToWhole = 12582912.0f; // 1.5 * 2^23: no fractions are left beside it
    const Four scaled = smaller(larger(x * 1.44269504f, four(-126.0f)), four(126.0f));
    const Four whole = scaled + kToWhole;
    const Four f = scaled - (whole - kToWhole);
    Four p = f * 1.3333558e-3f + 9.6181291e-3f;
    p = p * f + 5.5504109e-2f;
    p = p * f + 2.4022651e-1f;
    p = p * f + 6.9314718e-1f;
    p = p * f + 1.0f;
    FourInts power; // the lowest bits of `whole` are the exponent
    std::memcpy(&power, &whole, sizeof(power));
    power = (power + 127) << 23;
    Four scale;
    std::memcpy(&scale, &power, sizeof(scale));
    return p * scale;
}

} // namespace celadon
