#include "subedit/range_table.h"

#include "subedit/assert.h"
#include "subedit/multiversion.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace celadon::subedit {

namespace {

/// Largest error, times T, that sampling at T per unit length can make in any integral of P r up to
/// 1: a step of the sum is off by at most the variation of P r within it over T, and the last one,
/// which may be cut, by its height besides.
double largestSamplingError(const MeanProfile& profile) {
    const std::span<const double> samples = profile.samples();
    const double width = 1.0 / static_cast<double>(samples.size() - 1);
    double variation = 0.0;
    double highest = 0.0;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const double start = samples[i] * static_cast<double>(i) * width;
        const double end = samples[i + 1] * static_cast<double>(i + 1) * width;
        // P is linear within, P r a parabola: it may bulge beyond its ends by this.
        const double bulge = std::abs(samples[i + 1] - samples[i]) * width * 0.25;
        variation += std::abs(end - start) + 2.0 * bulge;
        highest = std::max(highest, std::max(start, end) + bulge);
    }
    return variation + highest;
}

constexpr int kLeastPhases = 16;
constexpr int kMostPhases = 256;
constexpr int kLanes = 8;

/// The mean profile in single precision: energies of 1 in all are summed to 1e-6, far below any
/// epsilon that makes sense. Some zeros follow, so that whole vectors can be read anywhere.
struct FloatProfile {
    std::vector<float> samples;
    std::vector<float> beyond;
    int intervals;
    explicit FloatProfile(const MeanProfile& profile)
        : samples(profile.samples().begin(), profile.samples().end()),
          beyond(profile.samplesBeyond().begin(), profile.samplesBeyond().end()),
          intervals(static_cast<int>(samples.size()) - 1) {
        samples.resize(samples.size() + kLanes);
        beyond.resize(beyond.size() + kLanes);
    }
};

using EightInts = std::int32_t __attribute__((vector_size(32)));

/// Where eq. 14 first fails for eight phases: the row, that is how many terms P r lie above.
/// @param samples, beyond of a FloatProfile
/// @param offset  of the phases, rising by less than an interval: r = 1 - row step - offset
/// @param rows    to look at
/// @param fails   of the eight, which fail in that row, as -1; undefined where none does
/// @return        rows if none fails
CELADON_MULTIVERSION int firstFailure(const float* __restrict samples,
                                      const float* __restrict beyond, int intervals,
                                      const float* __restrict offset, double step, float limit,
                                      int rows, std::int32_t* __restrict fails) {
    const auto perUnit = static_cast<float>(intervals);
    const float width = 1.0f / perUnit;
    const auto stepInFloat = static_cast<float>(step);
    Eight offsets;
    std::memcpy(&offsets, offset, sizeof(offsets));
    Eight sum{};
    for (int row = 0; row < rows; ++row) {
        const Eight r = static_cast<float>(1.0 - row * step) - offsets;
        const EightInts isInside = r >= 0.0f;
        const Eight position = (isInside ? r : Eight{}) * perUnit;
        EightInts k = __builtin_convertvector(position, EightInts);
        k = k < intervals - 1 ? k : EightInts{} + (intervals - 1);
        // The intervals of eight phases lie side by side: read at once, then put in order.
        const int first = k[kLanes - 1];
        Eight starts;
        Eight ends;
        Eight beyonds;
        std::memcpy(&starts, samples + first, sizeof(starts));
        std::memcpy(&ends, samples + first + 1, sizeof(ends));
        std::memcpy(&beyonds, beyond + first + 1, sizeof(beyonds));
        const EightInts place = k - first;
        const Eight start = CELADON_CHOOSE(starts, place);
        const Eight end = CELADON_CHOOSE(ends, place);
        const Eight t = position - __builtin_convertvector(k, Eight);
        const Eight p = start + (end - start) * t;
        sum += p * r;
        // As MeanProfile::at(): the rest of the interval, on which P is linear, and all beyond.
        const Eight rest = (1.0f - t) * width;
        const Eight integral =
            CELADON_CHOOSE(beyonds, place) +
            rest * (r * 0.5f * (p + end) + rest * (p * (1.0f / 6) + end * (1.0f / 3)));
        const Eight error = sum * stepInFloat - integral;
        const EightInts isBad = isInside & ((error >= limit) | (error <= -limit));
        std::int64_t halves[4];
        std::memcpy(halves, &isBad, sizeof(halves));
        if (row > 0 && (halves[0] | halves[1] | halves[2] | halves[3]) != 0) {
            std::memcpy(fails, &isBad, sizeof(isBad));
            return row;
        }
    }
    return rows;
}

/// minimalRadius(), where it must be looked for.
double searchMinimalRadius(const FloatProfile& profile, double T, double epsilon) {
    // All r' that are a whole number of steps and a phase below 1 share their terms. One row of
    // phases after the other, down from 1: the first r' that fails is the highest of those looked
    // at. The last phase, just short of a step, is the limit in which the term at r = 1 has just
    // dropped out.
    const int wanted =
        std::clamp(static_cast<int>(std::ceil(1024.0 / T)), kLeastPhases, kMostPhases);
    const int count = (wanted + kLanes - 1) / kLanes * kLanes;
    const int phases = count - 1;
    const double step = 1.0 / T;
    std::array<float, kMostPhases> offset;
    for (int i = 0; i < phases; ++i) {
        offset[static_cast<std::size_t>(i)] = static_cast<float>(step * i / phases);
    }
    offset[static_cast<std::size_t>(phases)] = static_cast<float>(step * (1.0 - 1e-6));
    const int allRows = static_cast<int>(std::floor(T)) + 1;
    int row = allRows;
    int phase = 0;
    for (int i = 0; i < count; i += kLanes) {
        std::array<std::int32_t, kLanes> fails;
        const int found =
            firstFailure(profile.samples.data(), profile.beyond.data(), profile.intervals,
                         offset.data() + i, step, static_cast<float>(epsilon), row, fails.data());
        if (found < row) { // of phases in the same row, the first
            row = found;
            phase = i + static_cast<int>(std::ranges::find(fails, -1) - fails.begin());
        }
    }
    if (row == allRows) {
        return 0.0;
    }
    // The next r' above this one that was looked at is up to a phase away: stay on its safe side.
    return phase == 0 && row == 1
               ? 1.0
               : std::min(1.0 - row * step - offset[static_cast<std::size_t>(phase)] +
                              step / phases,
                          1.0);
}

/// minimalRadius() with what does not depend on T computed before.
/// @param coarsest largestSamplingError()
double smallestRadius(const FloatProfile& profile, double coarsest, double T, double epsilon) {
    if (T <= 1.0) {
        return 1.0;
    }
    // Fine sampling: what the search would find, at a thousandth of its cost.
    return coarsest / T < epsilon ? 0.0 : searchMinimalRadius(profile, T, epsilon);
}

} // namespace

double samplingError(const MeanProfile& profile, double T, double rPrime) {
    double sum = 0.0;
    // Counted from r' in steps, with slack for 1 - r' being a whole number of steps but for a bit.
    const auto steps = static_cast<int>(std::floor((1.0 - rPrime) * T + 1e-9));
    for (int m = 0; m <= steps; ++m) {
        const double r = rPrime + m / T;
        sum += profile.value(r) * r;
    }
    return std::abs(sum / T - profile.energyBeyond(rPrime));
}

double minimalRadius(const MeanProfile& profile, double T, double epsilon) {
    return smallestRadius(FloatProfile(profile), largestSamplingError(profile), T, epsilon);
}

RangeTable RangeTable::build(const MeanProfile& profile, double epsilon) {
    CELADON_ASSERT(epsilon > 0.0);
    RangeTable table;
    const FloatProfile inFloat(profile);
    const double coarsest = largestSamplingError(profile);
    tbb::parallel_for(0, kRangeTableEntries, [&](int i) {
        const double T = std::exp2(static_cast<double>(i) / kRangeTableEntriesPerOctave);
        table.mValues[static_cast<std::size_t>(i)] =
            static_cast<float>(std::clamp(smallestRadius(inFloat, coarsest, T, epsilon), 0.0, 1.0));
    });
    return table;
}

RangeTable RangeTable::fromSamples(std::span<const double> T, std::span<const double> radius) {
    CELADON_ASSERT(!T.empty() && T.size() == radius.size());
    RangeTable table;
    for (std::size_t entry = 0; entry < table.mValues.size(); ++entry) {
        const double log = static_cast<double>(entry) / kRangeTableEntriesPerOctave;
        const auto above = std::ranges::upper_bound(T, std::exp2(log) * (1.0 + 1e-12));
        const auto next = static_cast<std::size_t>(above - T.begin());
        if (next == 0 || next == T.size()) {
            table.mValues[entry] = static_cast<float>(next == 0 ? radius.front() : radius.back());
            continue;
        }
        const double from = std::log2(T[next - 1]);
        const double t = (log - from) / (std::log2(T[next]) - from);
        table.mValues[entry] =
            static_cast<float>(std::lerp(radius[next - 1], radius[next], std::max(t, 0.0)));
    }
    return table;
}

float RangeTable::minimalRadius(float pixelsPerRadius) const {
    if (!(pixelsPerRadius > 1.0f)) {
        return 1.0f;
    }
    const float position = std::min(std::log2(pixelsPerRadius) * kRangeTableEntriesPerOctave,
                                    static_cast<float>(kRangeTableEntries - 1));
    const int i = std::min(static_cast<int>(position), kRangeTableEntries - 2);
    const float t = position - static_cast<float>(i);
    const float a = mValues[static_cast<std::size_t>(i)];
    const float b = mValues[static_cast<std::size_t>(i) + 1];
    return a + (b - a) * t;
}

} // namespace celadon::subedit
