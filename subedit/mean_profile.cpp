#include "subedit/mean_profile.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"
#include "subedit/multiversion.h"

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

/// e^x of an array.
CELADON_MULTIVERSION void exponentials(const float* __restrict x, int count,
                                       float* __restrict out) {
    for (int i = 0; i < count; ++i) {
        out[i] = fastExp(x[i]);
    }
}

/// Samples the summed channels of texels at r_i = i / N in units of R_P. Within a segment the
/// samples of ln P are equally spaced: P is multiplied by a constant from one to the next, and two
/// exponentials per segment and channel are enough.
class TexelSampler {
public:
    void sample(const float* logProfile, int segments, float samplesPerSegment,
                SampleArray& samples) {
        samples.fill(0.0f);
        const int used = layOut(logProfile, segments, samplesPerSegment);
        exponentials(mExponent.data(), used * 6, mExponential.data());
        int i = 0;
        for (int k = 0; k < used; ++k) {
            const float* start = mExponential.data() + k * 6;
            float p0 = start[0];
            float p1 = start[1];
            float p2 = start[2];
            for (; i < mEnd[static_cast<std::size_t>(k)]; ++i) {
                samples[static_cast<std::size_t>(i)] = p0 + p1 + p2;
                p0 *= start[3];
                p1 *= start[4];
                p2 *= start[5];
            }
        }
    }

private:
    /// ln P at the first sample of each segment and its change per sample, for the segments that
    /// have samples at all. @return their number
    int layOut(const float* logProfile, int segments, float samplesPerSegment) {
        const float segmentsPerSample = 1.0f / samplesPerSegment;
        int used = 0;
        int i = 0;
        for (int k = 0; k < segments && i < kSamples; ++k, logProfile += 3) {
            const float border = static_cast<float>(k + 1) * samplesPerSegment;
            const int end = border < static_cast<float>(kSamples)
                                ? static_cast<int>(std::ceil(border))
                                : kSamples;
            if (i >= end) {
                continue;
            }
            const float t = static_cast<float>(i) * segmentsPerSample - static_cast<float>(k);
            float* exponent = mExponent.data() + used * 6;
            for (int channel = 0; channel < 3; ++channel) {
                const float slope = logProfile[3 + channel] - logProfile[channel];
                exponent[channel] = logProfile[channel] + slope * t;
                exponent[3 + channel] = slope * segmentsPerSample;
            }
            mEnd[static_cast<std::size_t>(used++)] = end;
            i = end;
        }
        return used;
    }

    std::array<float, kMaxSegments * 6> mExponent;
    std::array<float, kMaxSegments * 6> mExponential;
    std::array<int, kMaxSegments> mEnd;
};

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

MeanProfileSums::MeanProfileSums(const MaterialMap& map, std::span<const float> effectiveRadiusMm)
    : mTilesX((map.width + kTileSize - 1) / kTileSize),
      mTilesY((map.height + kTileSize - 1) / kTileSize),
      mTiles(static_cast<std::size_t>(mTilesX) * static_cast<std::size_t>(mTilesY)),
      mRowSums(static_cast<std::size_t>(mTilesY), std::vector<double>(kSamples)) {
    update(map, effectiveRadiusMm, {0, 0, map.width, map.height});
}

void MeanProfileSums::update(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                             const TexelRect& rect) {
    CELADON_ASSERT(effectiveRadiusMm.size() ==
                   static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    if (rect.isEmpty()) {
        return;
    }
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const int firstX = rect.x / kTileSize;
    const int firstY = rect.y / kTileSize;
    const int countX = (rect.right() - 1) / kTileSize - firstX + 1;
    const int countY = (rect.bottom() - 1) / kTileSize - firstY + 1;

    // Tiles summed each in a fixed order: the same bits whatever the number of cores.
    tbb::parallel_for(0, countX * countY, [&](int i) {
        const int tileX = firstX + i % countX;
        const int tileY = firstY + i / countX;
        Sum& sum = mTiles[static_cast<std::size_t>(tileY) * static_cast<std::size_t>(mTilesX) +
                          static_cast<std::size_t>(tileX)];
        sum.fill(0.0f);
        Sum samples;
        TexelSampler sampler;
        for (int y = tileY * kTileSize; y < std::min(map.height, (tileY + 1) * kTileSize); ++y) {
            for (int x = tileX * kTileSize; x < std::min(map.width, (tileX + 1) * kTileSize); ++x) {
                const std::size_t texel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                    static_cast<std::size_t>(x);
                const float samplesPerSegment =
                    h / effectiveRadiusMm[texel] * kMeanProfileIntervals;
                sampler.sample(map.logProfile.data() + texel * stride, map.segments,
                               samplesPerSegment, samples);
                const float scale = 1.0f / std::max(trapezoidEnergy(samples), 1e-30f);
                for (std::size_t s = 0; s < kSamples; ++s) {
                    sum[s] += samples[s] * scale;
                }
            }
        }
    });
    for (int tileY = firstY; tileY < firstY + countY; ++tileY) {
        std::vector<double>& row = mRowSums[static_cast<std::size_t>(tileY)];
        row.assign(kSamples, 0.0);
        for (int tileX = 0; tileX < mTilesX; ++tileX) {
            const Sum& sum =
                mTiles[static_cast<std::size_t>(tileY) * static_cast<std::size_t>(mTilesX) +
                       static_cast<std::size_t>(tileX)];
            for (std::size_t s = 0; s < kSamples; ++s) {
                row[s] += static_cast<double>(sum[s]);
            }
        }
    }
}

MeanProfile MeanProfileSums::mean() const {
    std::vector<double> mean(kSamples, 0.0);
    for (const std::vector<double>& row : mRowSums) {
        for (std::size_t s = 0; s < kSamples; ++s) {
            mean[s] += row[s];
        }
    }
    return MeanProfile(std::move(mean));
}

MeanProfile meanProfile(const MaterialMap& map, std::span<const float> effectiveRadiusMm) {
    return MeanProfileSums(map, effectiveRadiusMm).mean();
}

} // namespace celadon::subedit
