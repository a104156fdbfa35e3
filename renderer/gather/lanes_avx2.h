#pragma once

// Eight lanes of AVX2 with FMA, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

struct Lanes {
    static constexpr int kCount = 8;
    using Float = __m256;
    using Int = __m256i;
    using Mask = __m256;

    static Float set(float v) { return _mm256_set1_ps(v); }
    static Float load(const float* p) { return _mm256_load_ps(p); }
    static void store(float* p, Float v) { _mm256_store_ps(p, v); }
    static Float minimum(Float a, Float b) { return _mm256_min_ps(a, b); }
    static Float maximum(Float a, Float b) { return _mm256_max_ps(a, b); }
    static Mask less(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
    static Mask atMost(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
    static Mask both(Mask a, Mask b) { return _mm256_and_ps(a, b); }
    static Mask without(Mask a, Mask b) { return _mm256_andnot_ps(b, a); }
    static bool any(Mask m) { return _mm256_movemask_ps(m) != 0; }
    static int count(Mask m) { return __builtin_popcount(unsigned(_mm256_movemask_ps(m))); }
    static Float select(Mask m, Float a, Float b) { return _mm256_blendv_ps(b, a, m); }
    static Float sqrt(Float x) { return _mm256_sqrt_ps(x); }
    static Float round(Float x) { ///< to the nearest
        return _mm256_round_ps(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    }
    /// x 2^n for whole n in [-126, 127].
    static Float scale(Float x, Float n) {
        const Int exponent =
            _mm256_slli_epi32(_mm256_add_epi32(_mm256_cvtps_epi32(n), _mm256_set1_epi32(127)), 23);
        return x * _mm256_castsi256_ps(exponent);
    }
    static Int toInt(Float x) { return _mm256_cvttps_epi32(x); } ///< towards zero
    static Float toFloat(Int x) { return _mm256_cvtepi32_ps(x); }
    static Int iota() { return _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0); }
    static Int add(Int a, int b) { return _mm256_add_epi32(a, _mm256_set1_epi32(b)); }
    static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
    static Int times64(Int a) { return _mm256_slli_epi32(a, 6); }
    static Int gather(const std::uint32_t* base, Int index) {
        return _mm256_i32gather_epi32(reinterpret_cast<const int*>(base), index, 4);
    }
    static Int lowHalf(Int x) { return _mm256_and_si256(x, _mm256_set1_epi32(0xffff)); }
    static Int highHalf(Int x) { return _mm256_srli_epi32(x, 16); }

    /// A profile, from codes to floats.
    struct Table {
        alignas(32) float values[kTableSize];

        void fill(const std::uint16_t* codes, int segments) {
            for (int k = 0; k <= segments; k += 8) {
                const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes + k));
                _mm256_store_ps(values + k, toFloat(_mm256_cvtepu16_epi32(eight)));
            }
        }
        /// Value at the start of a segment, and its change to the end.
        void at(Int segment, Float& from, Float& difference) const {
            from = _mm256_i32gather_ps(values, segment, 4);
            difference = _mm256_i32gather_ps(values + 1, segment, 4) - from;
        }
    };
};

} // namespace
} // namespace celadon::gather
