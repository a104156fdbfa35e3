#pragma once

// Eight records of eight 16-bit codes (two knots of a profile each), turned into vectors of one
// color each. Included where AVX2 is on.

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

struct EightEnds {
    __m256 start[3], change[3];
};

/// Records 0 to 3 in the low halves, 4 to 7 in the high halves.
inline EightEnds turnRecords(__m256i a, __m256i b, __m256i c, __m256i d) {
    const __m256i zero = _mm256_setzero_si256();
    EightEnds ends;
    __m256i first[3];
    for (int end = 0; end < 2; ++end) {
        const __m256i ab = end == 0 ? _mm256_unpacklo_epi16(a, b) : _mm256_unpackhi_epi16(a, b);
        const __m256i cd = end == 0 ? _mm256_unpacklo_epi16(c, d) : _mm256_unpackhi_epi16(c, d);
        const __m256i redGreen = _mm256_unpacklo_epi32(ab, cd);
        const __m256i blue = _mm256_unpackhi_epi32(ab, cd);
        const __m256i channels[3] = {_mm256_unpacklo_epi16(redGreen, zero),
                                     _mm256_unpackhi_epi16(redGreen, zero),
                                     _mm256_unpacklo_epi16(blue, zero)};
        for (int i = 0; i < 3; ++i) {
            if (end == 0) {
                first[i] = channels[i];
                ends.start[i] = _mm256_cvtepi32_ps(channels[i]);
            } else {
                ends.change[i] = _mm256_cvtepi32_ps(_mm256_sub_epi32(channels[i], first[i]));
            }
        }
    }
    return ends;
}

inline __m128i record(const std::uint16_t* codes, std::int32_t index) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(codes + index));
}

inline EightEnds eightEnds(const std::uint16_t* codes, const std::int32_t* index) {
    const auto pair = [&](int i) {
        return _mm256_inserti128_si256(_mm256_castsi128_si256(record(codes, index[i])),
                                       record(codes, index[i + 4]), 1);
    };
    return turnRecords(pair(0), pair(1), pair(2), pair(3));
}

inline EightEnds eightMeanEnds(const std::uint16_t* a, const std::int32_t* indexA,
                               const std::uint16_t* b, const std::int32_t* indexB) {
    const auto mean = [&](int i) {
        return _mm_avg_epu16(record(a, indexA[i]), record(b, indexB[i]));
    };
    const auto pair = [&](int i) {
        return _mm256_inserti128_si256(_mm256_castsi128_si256(mean(i)), mean(i + 4), 1);
    };
    return turnRecords(pair(0), pair(1), pair(2), pair(3));
}

inline void addEightColors(float (*sums)[4], const std::int32_t* pixel, const __m256* color) {
    const __m256 zero = _mm256_setzero_ps();
    const __m256d redGreen[2] = {_mm256_castps_pd(_mm256_unpacklo_ps(color[0], color[1])),
                                 _mm256_castps_pd(_mm256_unpackhi_ps(color[0], color[1]))};
    const __m256d blue[2] = {_mm256_castps_pd(_mm256_unpacklo_ps(color[2], zero)),
                             _mm256_castps_pd(_mm256_unpackhi_ps(color[2], zero))};
    for (int i = 0; i < 4; ++i) {
        const __m256 both =
            _mm256_castpd_ps(i % 2 == 0 ? _mm256_unpacklo_pd(redGreen[i / 2], blue[i / 2])
                                        : _mm256_unpackhi_pd(redGreen[i / 2], blue[i / 2]));
        float* low = sums[pixel[i]];
        _mm_store_ps(low, _mm_load_ps(low) + _mm256_castps256_ps128(both));
        float* high = sums[pixel[i + 4]];
        _mm_store_ps(high, _mm_load_ps(high) + _mm256_extractf128_ps(both, 1));
    }
}

} // namespace
} // namespace celadon::gather
