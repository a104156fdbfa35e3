#pragma once

// Eight lanes of AVX2 with FMA, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/eight_records.h"
#include "renderer/gather/pair_kernel.h"

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

/// For each mask of eight bits, the lanes that are set, in order.
struct CompressionTable {
    std::uint8_t lanes[256][8] = {};

    constexpr CompressionTable() {
        for (int mask = 0; mask < 256; ++mask) {
            int next = 0;
            for (int lane = 0; lane < 8; ++lane) {
                if ((mask >> lane & 1) != 0) {
                    lanes[mask][next++] = static_cast<std::uint8_t>(lane);
                }
            }
        }
    }
};

alignas(64) constexpr CompressionTable kCompression;

struct Lanes {
    static constexpr int kCount = 8;
    using Float = __m256;
    using Int = __m256i;
    using Mask = __m256;
    using Ends = EightEnds;
    struct Run {
        Float code[kRunKnots][3];
    };

    static Float set(float v) { return _mm256_set1_ps(v); }
    static Float load(const float* p) { return _mm256_loadu_ps(p); }
    static Int load(const std::int32_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    static void store(float* p, Float v) { _mm256_storeu_ps(p, v); }
    static void store(std::int32_t* p, Int v) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v);
    }
    static Float minimum(Float a, Float b) { return _mm256_min_ps(a, b); }
    static Float maximum(Float a, Float b) { return _mm256_max_ps(a, b); }
    static Mask less(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
    static Mask atMost(Float a, Float b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
    static Mask both(Mask a, Mask b) { return _mm256_and_ps(a, b); }
    static Mask without(Mask a, Mask b) { return _mm256_andnot_ps(b, a); }
    static unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(m)); }
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

    class Compression {
    public:
        explicit Compression(Mask m)
            : mOrder(_mm256_cvtepu8_epi32(
                  _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kCompression.lanes[bits(m)])))) {
        }
        void store(float* out, Float v) const {
            _mm256_storeu_ps(out, _mm256_permutevar8x32_ps(v, mOrder));
        }
        void store(std::int32_t* out, Int v) const {
            Lanes::store(out, _mm256_permutevar8x32_epi32(v, mOrder));
        }

    private:
        Int mOrder;
    };
    static Float gather(const float* base, const std::int32_t* index) {
        return _mm256_i32gather_ps(base, load(index), 4);
    }
    static Ends ends(const std::uint16_t* codes, const std::int32_t* index) {
        return eightEnds(codes, index);
    }
    static Ends meanEnds(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                         const std::int32_t* indexB) {
        return eightMeanEnds(a, indexA, b, indexB);
    }
    static Run run(const std::uint16_t* codes, const std::int32_t* index) {
        return turned([&](int i) { return runRecord(codes, index[i]); });
    }
    static Run meanRun(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                       const std::int32_t* indexB) {
        return turned([&](int i) {
            return _mm256_avg_epu16(runRecord(a, indexA[i]), runRecord(b, indexB[i]));
        });
    }
    static void addColors(float (*sums)[4], const std::int32_t* pixel, const Float* color) {
        addEightColors(sums, pixel, color);
    }

private:
    /// In the low halves of the records knots 0 and 1, in the high ones 2 and 3.
    template<class Record>
    static Run turned(const Record& record) {
        struct Colors {
            Int redGreen[2], blue[2]; ///< [knot % 2]
        };
        const auto four = [&](int first) {
            const Int a = record(first), b = record(first + 1);
            const Int c = record(first + 2), d = record(first + 3);
            const Int evenAB = _mm256_unpacklo_epi16(a, b), oddAB = _mm256_unpackhi_epi16(a, b);
            const Int evenCD = _mm256_unpacklo_epi16(c, d), oddCD = _mm256_unpackhi_epi16(c, d);
            return Colors{
                {_mm256_unpacklo_epi32(evenAB, evenCD), _mm256_unpacklo_epi32(oddAB, oddCD)},
                {_mm256_unpackhi_epi32(evenAB, evenCD), _mm256_unpackhi_epi32(oddAB, oddCD)}};
        };
        const Colors low = four(0);
        const Colors high = four(4);
        const Int zero = _mm256_setzero_si256();
        Run run;
        const auto put = [&](int knot, Int redGreen, Int blue) {
            run.code[knot][0] = _mm256_cvtepi32_ps(_mm256_unpacklo_epi16(redGreen, zero));
            run.code[knot][1] = _mm256_cvtepi32_ps(_mm256_unpackhi_epi16(redGreen, zero));
            run.code[knot][2] = _mm256_cvtepi32_ps(_mm256_unpacklo_epi16(blue, zero));
        };
        for (int odd = 0; odd < 2; ++odd) {
            put(odd, _mm256_permute2x128_si256(low.redGreen[odd], high.redGreen[odd], 0x20),
                _mm256_permute2x128_si256(low.blue[odd], high.blue[odd], 0x20));
            put(odd + 2, _mm256_permute2x128_si256(low.redGreen[odd], high.redGreen[odd], 0x31),
                _mm256_permute2x128_si256(low.blue[odd], high.blue[odd], 0x31));
        }
        return run;
    }
};

} // namespace
} // namespace celadon::gather
