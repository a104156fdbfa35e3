#include "subedit/range_table.h"

#include "subedit/assert.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

/// Largest error that sampling at T per unit length can make in any integral of P r up to 1: a step
/// of the sum is off by at most the variation of P r within it over T, and the last one, which may
/// be cut, by its height besides.
double largestSamplingError(const MeanProfile& profile, double T) {
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
    return (variation + highest) / T;
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
    if (T <= 1.0) {
        return 1.0;
    }
    if (largestSamplingError(profile, T) < epsilon) {
        return 0.0; // fine sampling: what the search below would find, at a thousandth of its cost
    }
    // All r' that are a whole number of steps and a phase below 1 share their terms: one pass down
    // from 1 per phase, each pass only as far down as the others have left in question. The phase
    // just short of a step is the limit in which the term at r = 1 has just dropped out.
    const int phases = std::clamp(static_cast<int>(std::ceil(2048.0 / T)), 16, 256);
    const double step = 1.0 / T;
    double radius = 0.0; // every r' above it that was looked at is good
    for (int i = 0; i <= phases; ++i) {
        const double phase = i < phases ? step * i / phases : step * (1.0 - 1e-6);
        double sum = profile.value(1.0 - phase) * (1.0 - phase);
        for (int m = 1;; ++m) {
            const double rPrime = 1.0 - phase - m * step;
            if (rPrime < radius || rPrime < 0.0) {
                break;
            }
            const MeanProfile::Point point = profile.at(rPrime);
            sum += point.value * rPrime;
            if (std::abs(sum * step - point.energyBeyond) >= epsilon) {
                // The next r' looked at above this one is up to a phase away: stay on its safe
                // side.
                radius = i == 0 && m == 1 ? 1.0 : rPrime + step / phases;
                break;
            }
        }
        if (radius >= 1.0) {
            return 1.0;
        }
    }
    return radius;
}

RangeTable RangeTable::build(const MeanProfile& profile, double epsilon) {
    CELADON_ASSERT(epsilon > 0.0);
    RangeTable table;
    tbb::parallel_for(0, kRangeTableEntries, [&](int i) {
        const double T = std::exp2(static_cast<double>(i) / kRangeTableEntriesPerOctave);
        table.mValues[static_cast<std::size_t>(i)] =
            static_cast<float>(std::clamp(subedit::minimalRadius(profile, T, epsilon), 0.0, 1.0));
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
