#pragma once

// Eight lanes in plain loops for any processor, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>

namespace celadon::gather {
namespace {

struct Lanes {
    static constexpr int kCount = 8;
    using Float = float __attribute__((vector_size(32)));
    using Int = std::int32_t __attribute__((vector_size(32)));
    using Mask = Int;

    static Float set(float v) { return Float{v, v, v, v, v, v, v, v}; }
    static Float load(const float* p) {
        Float v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    static void store(float* p, Float v) { __builtin_memcpy(p, &v, sizeof v); }
    static Float minimum(Float a, Float b) { return a < b ? a : b; }
    static Float maximum(Float a, Float b) { return a > b ? a : b; }
    static Mask less(Float a, Float b) { return a < b; }
    static Mask atMost(Float a, Float b) { return a <= b; }
    static Mask both(Mask a, Mask b) { return a & b; }
    static Mask without(Mask a, Mask b) { return a & ~b; }
    static int count(Mask m) {
        int sum = 0;
        for (int i = 0; i < kCount; ++i) {
            sum -= m[i];
        }
        return sum;
    }
    static bool any(Mask m) { return count(m) != 0; }
    static Float select(Mask m, Float a, Float b) { return m ? a : b; }
    static Float sqrt(Float x) {
        Float out;
        for (int i = 0; i < kCount; ++i) {
            out[i] = __builtin_sqrtf(x[i]);
        }
        return out;
    }
    static Float round(Float x) {             ///< to the nearest, |x| < 2^22
        constexpr float kRound = 12582912.0f; // 1.5 * 2^23
        return (x + kRound) - kRound;
    }
    /// x 2^n for whole n in [-126, 127].
    static Float scale(Float x, Float n) {
        return x * reinterpret_cast<Float>((__builtin_convertvector(n, Int) + 127) << 23);
    }
    static Int toInt(Float x) { return __builtin_convertvector(x, Int); } ///< towards zero
    static Float toFloat(Int x) { return __builtin_convertvector(x, Float); }
    static Int iota() { return Int{0, 1, 2, 3, 4, 5, 6, 7}; }
    static Int add(Int a, int b) { return a + b; }
    static Int add(Int a, Int b) { return a + b; }
    static Int times64(Int a) { return a << 6; }
    static Int gather(const std::uint32_t* base, Int index) {
        Int out;
        for (int i = 0; i < kCount; ++i) {
            out[i] = static_cast<std::int32_t>(base[index[i]]);
        }
        return out;
    }
    static Int lowHalf(Int x) { return x & 0xffff; }
    static Int highHalf(Int x) { return (x >> 16) & 0xffff; }

    /// A profile, from codes to floats.
    struct Table {
        float values[kTableSize];

        void fill(const std::uint16_t* codes, int segments) {
            for (int k = 0; k <= segments; ++k) {
                values[k] = static_cast<float>(codes[k]);
            }
        }
        /// Value at the start of a segment, and its change to the end.
        void at(Int segment, Float& from, Float& difference) const {
            for (int i = 0; i < kCount; ++i) {
                const float* v = values + segment[i];
                from[i] = v[0];
                difference[i] = v[1] - v[0];
            }
        }
    };
};

} // namespace
} // namespace celadon::gather
