#pragma once

// Sixteen lanes of AVX-512, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/eight_records.h"
#include "renderer/gather/pair_kernel.h"
#include "renderer/gather/turn_runs.h"

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

struct Lanes : TurnedRuns<Lanes> {
    static constexpr int kCount = 16;
    using Float = __m512;
    using Int = __m512i;
    using Mask = __mmask16;

    static Float set(float v) { return _mm512_set1_ps(v); }
    static Float load(const float* p) { return _mm512_loadu_ps(p); }
    static Int load(const std::int32_t* p) { return _mm512_loadu_si512(p); }
    static void store(float* p, Float v) { _mm512_storeu_ps(p, v); }
    static void store(std::int32_t* p, Int v) { _mm512_storeu_si512(p, v); }
    static Float minimum(Float a, Float b) { return _mm512_min_ps(a, b); }
    static Float maximum(Float a, Float b) { return _mm512_max_ps(a, b); }
    static Mask less(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
    static Mask atMost(Float a, Float b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static Mask both(Mask a, Mask b) { return static_cast<Mask>(a & b); }
    static Mask without(Mask a, Mask b) { return static_cast<Mask>(a & ~b); }
    static unsigned bits(Mask m) { return m; }
    static Float select(Mask m, Float a, Float b) { return _mm512_mask_blend_ps(m, b, a); }
    static Float sqrt(Float x) { // one Newton step: from 2^-14 to 2^-26
        const Float safe = maximum(x, set(1e-30f));
        const Float r = _mm512_rsqrt14_ps(safe);
        return safe * (r * (set(1.5f) - set(0.5f) * safe * r * r));
    }
    static Float round(Float x) { return _mm512_roundscale_ps(x, 0); } ///< to the nearest
    /// x 2^n for whole n.
    static Float scale(Float x, Float n) { return _mm512_scalef_ps(x, n); }
    static Int toInt(Float x) { return _mm512_cvttps_epi32(x); } ///< towards zero
    static Float toFloat(Int x) { return _mm512_cvtepi32_ps(x); }

    class Compression {
    public:
        explicit Compression(Mask m) : mMask(m) {}
        void store(float* out, Float v) const {
            _mm512_storeu_ps(out, _mm512_maskz_compress_ps(mMask, v));
        }
        void store(std::int32_t* out, Int v) const {
            _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(mMask, v));
        }

    private:
        Mask mMask;
    };
    static Float gather(const float* base, const std::int32_t* index) {
        return _mm512_i32gather_ps(load(index), base, 4);
    }

    struct Ends {
        Float start[3], change[3];
    };
    static Ends ends(const std::uint16_t* codes, const std::int32_t* index) {
        return join(eightEnds(codes, index), eightEnds(codes, index + 8));
    }
    static Ends meanEnds(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                         const std::int32_t* indexB) {
        return join(eightMeanEnds(a, indexA, b, indexB),
                    eightMeanEnds(a, indexA + 8, b, indexB + 8));
    }
    struct Run {
        Float code[kRunKnots][3];
    };
    /// For TurnedRuns.
    template<class Record>
    static Int rows(const Record& record, int i) {
        return _mm512_inserti64x4(_mm512_castsi256_si512(record(i)), record(i + 4), 1);
    }
    static Int zero() { return _mm512_setzero_si512(); }
    static Int low16(Int a, Int b) { return _mm512_unpacklo_epi16(a, b); }
    static Int high16(Int a, Int b) { return _mm512_unpackhi_epi16(a, b); }
    static Int low32(Int a, Int b) { return _mm512_unpacklo_epi32(a, b); }
    static Int high32(Int a, Int b) { return _mm512_unpackhi_epi32(a, b); }
    static Int firstKnots(Int a, Int b) { return _mm512_shuffle_i64x2(a, b, 0x88); }
    static Int lastKnots(Int a, Int b) { return _mm512_shuffle_i64x2(a, b, 0xdd); }
    static void addColors(float (*sums)[4], const std::int32_t* pixel, const Float* color) {
        for (int half = 0; half < 2; ++half) {
            __m256 part[3];
            for (int c = 0; c < 3; ++c) {
                part[c] = half == 0 ? _mm512_castps512_ps256(color[c])
                                    : _mm512_extractf32x8_ps(color[c], 1);
            }
            addEightColors(sums, pixel + 8 * half, part);
        }
    }

private:
    static Ends join(const EightEnds& low, const EightEnds& high) {
        Ends ends;
        for (int c = 0; c < 3; ++c) {
            ends.start[c] =
                _mm512_insertf32x8(_mm512_castps256_ps512(low.start[c]), high.start[c], 1);
            ends.change[c] =
                _mm512_insertf32x8(_mm512_castps256_ps512(low.change[c]), high.change[c], 1);
        }
        return ends;
    }
};

} // namespace
} // namespace celadon::gather
