#include "subedit/mean_profile.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::subedit {

namespace {

constexpr int kSamples = kMeanProfileIntervals + 1;
using SampleArray = std::array<float, kSamples>;

/// Integral of P r dr over [start, start + width] for P linear from p0 to p1.
double linearEnergy(double p0, double p1, double start, double width) {
    return width * (start * 0.5 * (p0 + p1) + width * (p0 / 6.0 + p1 / 3.0));
}

/// Summed channels of one texel at the samples r_i = i / N in units of R_P. Within a segment the
/// samples of ln P are equally spaced, so that P is multiplied by a constant from one to the next.
void sampleTexel(const float* logProfile, int segments, float samplesPerSegment,
                 SampleArray& samples) {
    samples.fill(0.0f);
    const float segmentsPerSample = 1.0f / samplesPerSegment;
    int i = 0;
    for (int k = 0; k < segments && i < kSamples; ++k, logProfile += 3) {
        const int end = std::min(
            kSamples, static_cast<int>(std::ceil(static_cast<float>(k + 1) * samplesPerSegment)));
        if (i >= end) {
            continue;
        }
        const float t = static_cast<float>(i) * segmentsPerSample - static_cast<float>(k);
        std::array<float, 3> value;
        std::array<float, 3> ratio;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const float slope = logProfile[3 + channel] - logProfile[channel];
            value[channel] = fastExp(logProfile[channel] + slope * t);
            ratio[channel] = fastExp(slope * segmentsPerSample);
        }
        for (; i < end; ++i) {
            samples[static_cast<std::size_t>(i)] = value[0] + value[1] + value[2];
            value[0] *= ratio[0];
            value[1] *= ratio[1];
            value[2] *= ratio[2];
        }
    }
}

/// Energy of a texel's samples, to the accuracy that C needs (trapezoids of P r).
float trapezoidEnergy(const SampleArray& samples) {
    std::array<float, 4> partial{}; // four sums that do not wait for each other
    for (int i = 1; i < kMeanProfileIntervals; ++i) {
        partial[static_cast<std::size_t>(i & 3)] +=
            samples[static_cast<std::size_t>(i)] * static_cast<float>(i);
    }
    const float ends = 0.5f * samples[kMeanProfileIntervals] * kMeanProfileIntervals;
    return (partial[0] + partial[1] + partial[2] + partial[3] + ends) /
           (static_cast<float>(kMeanProfileIntervals) * kMeanProfileIntervals);
}

} // namespace

MeanProfile::MeanProfile(std::vector<double> samples)
    : mSamples(std::move(samples)), mBeyond(mSamples.size(), 0.0) {
    CELADON_ASSERT(mSamples.size() >= 2);
    const double width = 1.0 / static_cast<double>(mSamples.size() - 1);
    for (std::size_t i = mSamples.size() - 1; i-- > 0;) {
        mBeyond[i] = mBeyond[i + 1] + linearEnergy(mSamples[i], mSamples[i + 1],
                                                   static_cast<double>(i) * width, width);
    }
    const double total = mBeyond.front();
    for (std::size_t i = 0; i < mSamples.size(); ++i) {
        mSamples[i] /= total;
        mBeyond[i] /= total;
    }
}

double MeanProfile::value(double r) const {
    const auto intervals = static_cast<double>(mSamples.size() - 1);
    const double position = std::clamp(r, 0.0, 1.0) * intervals;
    const auto i = std::min(static_cast<std::size_t>(position), mSamples.size() - 2);
    const double t = position - static_cast<double>(i);
    return mSamples[i] + (mSamples[i + 1] - mSamples[i]) * t;
}

double MeanProfile::energyBeyond(double r) const {
    const auto intervals = static_cast<double>(mSamples.size() - 1);
    const double start = std::clamp(r, 0.0, 1.0);
    const auto i = std::min(static_cast<std::size_t>(start * intervals), mSamples.size() - 2);
    const double end = static_cast<double>(i + 1) / intervals;
    return mBeyond[i + 1] + linearEnergy(value(start), mSamples[i + 1], start, end - start);
}

MeanProfile meanProfile(const MaterialMap& map, std::span<const float> effectiveRadiusMm) {
    const std::size_t texels = effectiveRadiusMm.size();
    CELADON_ASSERT(texels ==
                   static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);

    // Blocks of fixed size summed in a fixed order: the same bits whatever the number of cores.
    constexpr std::size_t kBlock = 1024;
    const std::size_t blocks = (texels + kBlock - 1) / kBlock;
    std::vector<SampleArray> sums(blocks);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        SampleArray& sum = sums[block];
        sum.fill(0.0f);
        SampleArray samples;
        for (std::size_t i = block * kBlock; i < std::min(texels, (block + 1) * kBlock); ++i) {
            const float samplesPerSegment = h / effectiveRadiusMm[i] * kMeanProfileIntervals;
            sampleTexel(map.logProfile.data() + i * stride, map.segments, samplesPerSegment,
                        samples);
            const float scale = 1.0f / std::max(trapezoidEnergy(samples), 1e-30f);
            for (std::size_t s = 0; s < kSamples; ++s) {
                sum[s] += samples[s] * scale;
            }
        }
    });
    std::vector<double> mean(kSamples, 0.0);
    for (const SampleArray& sum : sums) {
        for (std::size_t s = 0; s < kSamples; ++s) {
            mean[s] += static_cast<double>(sum[s]);
        }
    }
    return MeanProfile(std::move(mean));
}

} // namespace celadon::subedit
