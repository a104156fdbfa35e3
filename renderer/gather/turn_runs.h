#pragma once

// Runs of knots of 16-bit codes, turned into vectors of one color each. Included where AVX2 is on.

#include "renderer/gather/pair_kernel.h"

#include <cstdint>
#include <immintrin.h>

namespace celadon::gather {
namespace {

inline __m256i runRecord(const std::uint16_t* codes, std::int32_t index) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(codes + index));
}

/// @param record  that of a lane: kRunKnots knots
/// L::rows() has four or eight records of which every other 128 bits hold knots 0 and 1, the rest
/// knots 2 and 3; L::firstKnots() and L::lastKnots() take these apart.
template<class L, class Record>
typename L::Run turnRuns(const Record& record) {
    using Int = typename L::Int;
    struct Colors {
        Int redGreen[2], blue[2]; ///< [knot % 2]
    };
    const auto halfOfLanes = [&](int first) {
        const Int a = L::rows(record, first), b = L::rows(record, first + 1);
        const Int c = L::rows(record, first + 2), d = L::rows(record, first + 3);
        const Int evenAB = L::low16(a, b), oddAB = L::high16(a, b);
        const Int evenCD = L::low16(c, d), oddCD = L::high16(c, d);
        return Colors{{L::low32(evenAB, evenCD), L::low32(oddAB, oddCD)},
                      {L::high32(evenAB, evenCD), L::high32(oddAB, oddCD)}};
    };
    const Colors low = halfOfLanes(0);
    const Colors high = halfOfLanes(L::kCount / 2);
    const Int zero = L::zero();
    typename L::Run run;
    const auto put = [&](int knot, Int redGreen, Int blue) {
        run.code[knot][0] = L::toFloat(L::low16(redGreen, zero));
        run.code[knot][1] = L::toFloat(L::high16(redGreen, zero));
        run.code[knot][2] = L::toFloat(L::low16(blue, zero));
    };
    for (int odd = 0; odd < 2; ++odd) {
        put(odd, L::firstKnots(low.redGreen[odd], high.redGreen[odd]),
            L::firstKnots(low.blue[odd], high.blue[odd]));
        put(odd + 2, L::lastKnots(low.redGreen[odd], high.redGreen[odd]),
            L::lastKnots(low.blue[odd], high.blue[odd]));
    }
    return run;
}

/// Runs of knots of each lane's record, and means of two records', for lanes L.
template<class L>
struct TurnedRuns {
    static auto run(const std::uint16_t* codes, const std::int32_t* index) {
        return turnRuns<L>([&](int i) { return runRecord(codes, index[i]); });
    }
    static auto meanRun(const std::uint16_t* a, const std::int32_t* indexA, const std::uint16_t* b,
                        const std::int32_t* indexB) {
        return turnRuns<L>([&](int i) {
            return _mm256_avg_epu16(runRecord(a, indexA[i]), runRecord(b, indexB[i]));
        });
    }
};

} // namespace
} // namespace celadon::gather
