#include "subedit/range_table.h"

#include "subedit/assert.h"
#include "subedit/multiversion.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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

constexpr int kMostPhases = 256;
constexpr int kLanes = kMostPhases + 1;

/// Adds the next term P r to the sums of all phases, and gives how far each is from the integral.
/// @param samples, beyond of the mean profile, `intervals` + 1 values
/// @param offset  of each phase below `top`: its r is top - offset, >= 0
CELADON_MULTIVERSION void addTerm(const float* __restrict samples, const float* __restrict beyond,
                                  int intervals, const float* __restrict offset, int count,
                                  float top, float step, float* __restrict sum,
                                  float* __restrict error) {
    const auto perUnit = static_cast<float>(intervals);
    const float width = 1.0f / perUnit;
    for (int i = 0; i < count; ++i) {
        const float r = top - offset[i];
        const float position = r * perUnit;
        const int k = std::min(static_cast<int>(position), intervals - 1);
        const float t = position - static_cast<float>(k);
        const float end = samples[k + 1];
        const float p = samples[k] + (end - samples[k]) * t;
        // As MeanProfile::at(): the rest of the interval, on which P is linear, and all beyond.
        const float rest = (1.0f - t) * width;
        const float integral = beyond[k + 1] + rest * (r * 0.5f * (p + end) +
                                                       rest * (p * (1.0f / 6) + end * (1.0f / 3)));
        sum[i] += p * r;
        error[i] = std::abs(sum[i] * step - integral);
    }
}

/// The mean profile in single precision: energies of 1 in all are summed to 1e-6, far below any
/// epsilon that makes sense.
struct FloatProfile {
    std::vector<float> samples;
    std::vector<float> beyond;
    explicit FloatProfile(const MeanProfile& profile)
        : samples(profile.samples().begin(), profile.samples().end()),
          beyond(profile.samplesBeyond().begin(), profile.samplesBeyond().end()) {}
};

/// minimalRadius(), where it must be looked for.
double searchMinimalRadius(const FloatProfile& profile, double T, double epsilon) {
    // All r' that are a whole number of steps and a phase below 1 share their terms. One row of
    // phases after the other, down from 1: the first r' that fails is the highest of those looked
    // at. The phase just short of a step is the limit in which the term at r = 1 has just dropped
    // out.
    const int phases = std::clamp(static_cast<int>(std::ceil(1024.0 / T)), 16, kMostPhases);
    const double step = 1.0 / T;
    const auto limit = static_cast<float>(epsilon);
    std::array<float, kLanes> offset;
    std::array<float, kLanes> sum{};
    std::array<float, kLanes> error;
    for (int i = 0; i < phases; ++i) {
        offset[static_cast<std::size_t>(i)] = static_cast<float>(step * i / phases);
    }
    offset[static_cast<std::size_t>(phases)] = static_cast<float>(step * (1.0 - 1e-6));
    int count = phases + 1;
    for (int m = 0;; ++m) {
        const double top = 1.0 - m * step;
        while (count > 0 && top < offset[static_cast<std::size_t>(count - 1)]) {
            --count;
        }
        if (count == 0) {
            return 0.0;
        }
        addTerm(profile.samples.data(), profile.beyond.data(),
                static_cast<int>(profile.samples.size()) - 1, offset.data(), count,
                static_cast<float>(top), static_cast<float>(step), sum.data(), error.data());
        if (m == 0) {
            continue; // no whole step below 1
        }
        const float* const end = error.data() + count;
        const float* const bad =
            std::find_if(std::as_const(error).data(), end, [&](float e) { return e >= limit; });
        if (bad != end) {
            const auto i = static_cast<std::size_t>(bad - error.data());
            // The next r' above this one that was looked at is up to a phase away: stay on its safe
            // side.
            return i == 0 && m == 1 ? 1.0 : std::min(top - offset[i] + step / phases, 1.0);
        }
    }
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
