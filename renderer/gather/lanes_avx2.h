#pragma once

// Eight lanes of AVX2 with FMA, see pair_kernel.inl for what is asked of them.

#include "renderer/gather/eight_records.h"
#include "renderer/gather/pair_kernel.h"
#include "renderer/gather/turn_runs.h"

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

struct Lanes : TurnedRuns<Lanes> {
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
    /// For TurnedRuns.
    template<class Record>
    static Int rows(const Record& record, int i) {
        return record(i);
    }
    static Int zero() { return _mm256_setzero_si256(); }
    static Int low16(Int a, Int b) { return _mm256_unpacklo_epi16(a, b); }
    static Int high16(Int a, Int b) { return _mm256_unpackhi_epi16(a, b); }
    static Int low32(Int a, Int b) { return _mm256_unpacklo_epi32(a, b); }
    static Int high32(Int a, Int b) { return _mm256_unpackhi_epi32(a, b); }
    static Int firstKnots(Int a, Int b) { return _mm256_permute2x128_si256(a, b, 0x20); }
    static Int lastKnots(Int a, Int b) { return _mm256_permute2x128_si256(a, b, 0x31); }
    static void addColors(float (*sums)[4], const std::int32_t* pixel, const Float* color) {
        addEightColors(sums, pixel, color);
    }
};

} // namespace
} // namespace celadon::gather
