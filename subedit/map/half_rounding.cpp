#include "subedit/map/half_rounding.h"

#include "subedit/fast_exp.h"
#include "subedit/map/material_map.h"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace celadon::subedit {

namespace {

/// Bits of a half from a float that is one exactly.
std::uint16_t halfBits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000);
    const int exponent = static_cast<int>((bits >> 23) & 0xff) - 127 + 15;
    if (exponent <= 0) { // roundDown() leaves nothing between 0 and the smallest normal half
        return sign;
    }
    return static_cast<std::uint16_t>(sign | (exponent << 10) | ((bits >> 13) & 0x3ff));
}

/// The half next below (or at) `value`, and the step to the one above.
float roundDown(float value, float& step) {
    constexpr float kSmallestNormal = 6.103515625e-5f; // 2^-14
    if (std::abs(value) < kSmallestNormal) { // ln P this near 0: coarse enough to be 0 or 2^-14
        step = kSmallestNormal;
        return value < 0.0f ? -kSmallestNormal : 0.0f;
    }
    const int exponent = std::ilogb(value);
    step = std::ldexp(1.0f, exponent - 10);
    return std::floor(value / step) * step;
}

} // namespace

void roundKeepingAlbedo(const float* logProfile, int segments, std::uint16_t* halves) {
    const int knots = segments + 1;
    std::array<float, kMaxSegments + 1> rounded;
    std::array<float, kMaxSegments + 1> other; ///< the half on the other side of the true value
    std::array<float, kMaxSegments + 1>
        weight; ///< change of energy per change of ln P, times 3 / h^2
    for (int channel = 0; channel < 3; ++channel) {
        const auto logAt = [&](int k) { return logProfile[k * 3 + channel]; };
        float error = 0.0f;
        float halfwayBefore = 0.0f; // P r in the middle of the segment before knot k
        for (int k = 0; k < knots; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const float value = logAt(k);
            const auto r = static_cast<float>(k);
            // Integral of P r under the knot's hat function, by Simpson's rule on either side.
            const bool isInner = k > 0 && k < segments;
            const float halfwayAfter =
                k < segments ? fastExp(0.5f * (value + logAt(k + 1))) * (r + 0.5f) : 0.0f;
            weight[i] = halfwayBefore + halfwayAfter + (isInner ? 1.0f : 0.5f) * fastExp(value) * r;
            halfwayBefore = halfwayAfter;

            float step = 0.0f;
            const float below = roundDown(value, step);
            const float above = below + step;
            const bool isDown = value - below < above - value;
            rounded[i] = isDown ? below : above;
            other[i] = isDown ? above : below;
            error += weight[i] * (rounded[i] - value);
        }
        // From the center outwards, where weights fall off: each flip that helps leaves an error
        // that finer ones can mend.
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(knots); ++i) {
                const float flipped = error + weight[i] * (other[i] - rounded[i]);
                if (std::abs(flipped) < std::abs(error)) {
                    error = flipped;
                    std::swap(rounded[i], other[i]);
                }
            }
        }
        for (int k = 0; k < knots; ++k) {
            halves[k * 3 + channel] = halfBits(rounded[static_cast<std::size_t>(k)]);
        }
    }
}

} // namespace celadon::subedit
