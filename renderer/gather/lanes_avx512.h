#pragma once

// Sixteen lanes of AVX-512, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

struct Lanes {
    static constexpr int kCount = 16;
    using Float = __m512;
    using Int = __m512i;
    using Mask = __mmask16;

    static Float set(float v) { return _mm512_set1_ps(v); }
    static Float load(const float* p) { return _mm512_load_ps(p); }
    static void store(float* p, Float v) { _mm512_store_ps(p, v); }
    static Float minimum(Float a, Float b) { return _mm512_min_ps(a, b); }
    static Float maximum(Float a, Float b) { return _mm512_max_ps(a, b); }
    static Mask less(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static Mask atMost(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
    static Mask without(Mask a, Mask b) { return static_cast<Mask>(a & ~b); }
    static bool any(Mask m) { return m != 0; }
    static int count(Mask m) { return __builtin_popcount(m); }
    static Float select(Mask m, Float a, Float b) { return _mm512_mask_blend_ps(m, b, a); }
    static Float sqrt(Float x) { // two Newton steps are not needed: 2^-14, then 2^-26
        const Float safe = maximum(x, set(1e-30f));
        const Float r = _mm512_rsqrt14_ps(safe);
        return safe * (r * (set(1.5f) - set(0.5f) * safe * r * r));
    }
    static Float round(Float x) { return _mm512_roundscale_ps(x, 0); } ///< to the nearest
    /// x 2^n for whole n.
    static Float scale(Float x, Float n) { return _mm512_scalef_ps(x, n); }
    static Int toInt(Float x) { return _mm512_cvttps_epi32(x); } ///< towards zero
    static Float toFloat(Int x) { return _mm512_cvtepi32_ps(x); }
    static Int iota() {
        return _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    }
    static Int add(Int a, int b) { return _mm512_add_epi32(a, _mm512_set1_epi32(b)); }
    static Int add(Int a, Int b) { return _mm512_add_epi32(a, b); }
    static Int times64(Int a) { return _mm512_slli_epi32(a, 6); }
    static Int gather(const std::uint32_t* base, Int index) {
        return _mm512_i32gather_epi32(index, base, 4);
    }
    static Int lowHalf(Int x) { return _mm512_and_si512(x, _mm512_set1_epi32(0xffff)); }
    static Int highHalf(Int x) { return _mm512_srli_epi32(x, 16); }

    /// A profile of at most 32 segments in registers; a longer one in memory.
    struct Table {
        Float start[2], change[2];
        alignas(64) float values[kTableSize];
        bool small;

        void fill(const std::uint16_t* codes, int segments) {
            small = segments <= 32;
            if (small) {
                for (int i = 0; i < 2; ++i) {
                    start[i] = sixteen(codes + 16 * i);
                    change[i] = sixteen(codes + 16 * i + 1) - start[i];
                }
            } else {
                for (int k = 0; k <= segments; ++k) {
                    values[k] = static_cast<float>(codes[k]);
                }
            }
        }
        /// Value at the start of a segment, and its change to the end.
        void at(Int segment, Float& from, Float& difference) const {
            if (small) {
                from = _mm512_permutex2var_ps(start[0], segment, start[1]);
                difference = _mm512_permutex2var_ps(change[0], segment, change[1]);
                return;
            }
            from = _mm512_i32gather_ps(segment, values, 4);
            difference = _mm512_i32gather_ps(add(segment, 1), values, 4) - from;
        }

    private:
        static Float sixteen(const std::uint16_t* codes) {
            return toFloat(
                _mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(codes))));
        }
    };
};

} // namespace
} // namespace celadon::gather
