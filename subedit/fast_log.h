#pragma once

#include <bit>
#include <cstdint>

/// ln x for arrays of profiles, as fast_exp.h: no calls and no branches. Absolute error below 2e-7
/// (relative, where |ln x| > 1) for normal x > 0.
namespace celadon::subedit {

[[nodiscard]] inline float fastLog(float x) {
    // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t e = (bits - 0x3f3504f3) >> 23;
    const auto m = std::bit_cast<float>(bits - e * (1 << 23));
    // ln m = 2 artanh((m - 1) / (m + 1)); the first term left out is below 1e-9.
    const float s = (m - 1.0f) / (m + 1.0f);
    const float s2 = s * s;
    const float series =
        2.0f * s * (1.0f + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9)))));
    return static_cast<float>(e) * 0.69314718f + series;
}

} // namespace celadon::subedit
