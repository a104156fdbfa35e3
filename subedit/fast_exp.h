#pragma once

#include <bit>
#include <cstdint>

/// e^x for arrays of profiles: no calls and no branches, so that the compiler turns loops over it
/// into vector code. Relative error below 3e-7 for x in [-87, 88]; clamped outside.
namespace celadon::subedit {

[[nodiscard]] inline float fastExp(float x) {
    x = x > -87.0f ? x : -87.0f; // one instruction each, written this way around
    x = x < 88.0f ? x : 88.0f;
    // x = (n + f) ln 2 with f in [-1/2, 1/2]: adding 1.5 * 2^23 rounds to the nearest integer.
    constexpr float kRound = 12582912.0f;
    const float shifted = x * 1.44269504f + kRound;
    const float n = shifted - kRound;
    // ln 2 in two parts, so that the product with n is exact.
    const float f = (x - n * 0.693359375f) + n * 2.12194440e-4f;
    // Taylor series of e^f, |f| <= 0.3466; the first term left out is below 1.2e-7. In pairs, which
    // do not wait for each other.
    const float f2 = f * f;
    const float p = ((1.0f + f) + f2 * (0.5f + f * (1.0f / 6))) +
                    f2 * f2 * ((1.0f / 24 + f * (1.0f / 120)) + f2 * (1.0f / 720));
    const auto exponent =
        static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(shifted) << 23) + 0x3f800000;
    return p * std::bit_cast<float>(exponent);
}

} // namespace celadon::subedit
