#include "subedit/mean_profile.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"
#include "subedit/multiversion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace celadon::subedit {

namespace {

constexpr int kSamples = kMeanProfileIntervals + 1;
using SampleArray = std::array<float, kSamples>;
using Four = float __attribute__((vector_size(16))); // GCC and Clang alike

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
        const int used = layOut(logProfile, segments, samplesPerSegment);
        exponentials(mExponent.data(), used * 6, mExponential.data());
        int i = 0;
        for (int k = 0; k < used; ++k) {
            i = fill(mExponential.data() + k * 6, i, mEnd[static_cast<std::size_t>(k)],
                     samples.data());
        }
        std::fill(samples.begin() + i, samples.end(), 0.0f); // beyond r_s
    }

private:
    /// Samples from `i` to `end` of one segment, four at a time: one after the other each product
    /// would wait for the one before.
    /// @param start P of the channels at the first sample, then what they change by to the next
    /// @return      `end`
    static int fill(const float* start, int i, int end, float* samples) {
        std::array<Four, 3> p;
        std::array<Four, 3> step;
        for (std::size_t c = 0; c < 3; ++c) {
            const float ratio = start[3 + c];
            const float squared = ratio * ratio;
            p[c] = Four{1.0f, ratio, squared, squared * ratio} * start[c];
            const float fourth = squared * squared;
            step[c] = Four{fourth, fourth, fourth, fourth};
        }
        for (; i + 4 <= end; i += 4) {
            const Four sum = p[0] + p[1] + p[2];
            std::memcpy(samples + i, &sum, sizeof(sum));
            for (std::size_t c = 0; c < 3; ++c) {
                p[c] *= step[c];
            }
        }
        const Four sum = p[0] + p[1] + p[2];
        for (int j = 0; i < end; ++i, ++j) {
            samples[i] = sum[j];
        }
        return end;
    }

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
    static_assert(kMeanProfileIntervals % 8 == 0);
    std::array<Four, 2> sum{}; // that do not wait for each other
    std::array<Four, 2> index{Four{0.0f, 1.0f, 2.0f, 3.0f}, Four{4.0f, 5.0f, 6.0f, 7.0f}};
    for (std::size_t i = 0; i < kMeanProfileIntervals; i += 8) {
        for (std::size_t half = 0; half < 2; ++half) {
            Four p;
            std::memcpy(&p, samples.data() + i + 4 * half, sizeof(p));
            sum[half] += p * index[half];
            index[half] += 8.0f;
        }
    }
    const Four both = sum[0] + sum[1];
    const float ends = 0.5f * samples[kMeanProfileIntervals] * kMeanProfileIntervals;
    return ((both[0] + both[1]) + (both[2] + both[3]) + ends) /
           (static_cast<float>(kMeanProfileIntervals) * kMeanProfileIntervals);
}

CELADON_MULTIVERSION void addScaled(const float* __restrict samples, float scale,
                                    float* __restrict sum) {
    for (int i = 0; i < kSamples; ++i) {
        sum[i] += samples[i] * scale;
    }
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
    return at(r).value;
}

double MeanProfile::energyBeyond(double r) const {
    return at(r).energyBeyond;
}

MeanProfile::Point MeanProfile::at(double r) const {
    const auto intervals = static_cast<double>(mSamples.size() - 1);
    const double position = std::clamp(r, 0.0, 1.0) * intervals;
    const auto i = std::min(static_cast<std::size_t>(position), mSamples.size() - 2);
    const double t = position - static_cast<double>(i);
    const double p = mSamples[i] + (mSamples[i + 1] - mSamples[i]) * t;
    const double width = 1.0 / intervals;
    return {p,
            mBeyond[i + 1] + linearEnergy(p, mSamples[i + 1], position * width, (1.0 - t) * width)};
}

MeanProfileSums::MeanProfileSums(const MaterialMap& map, std::span<const float> effectiveRadiusMm)
    : mTilesX((map.width + kTileSize - 1) / kTileSize),
      mTilesY((map.height + kTileSize - 1) / kTileSize),
      mTiles(static_cast<std::size_t>(mTilesX) * static_cast<std::size_t>(mTilesY)),
      mRowSums(static_cast<std::size_t>(mTilesY), std::vector<double>(kSamples)) {
    const TexelRect whole{0, 0, map.width, map.height};
    update(map, effectiveRadiusMm, {&whole, 1});
}

void MeanProfileSums::update(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                             std::span<const TexelRect> rects) {
    CELADON_ASSERT(effectiveRadiusMm.size() ==
                   static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    std::vector<int> tiles;
    std::vector<int> rows;
    for (const TexelRect& rect : rects) {
        if (rect.isEmpty()) {
            continue;
        }
        for (int y = rect.y / kTileSize; y <= (rect.bottom() - 1) / kTileSize; ++y) {
            rows.push_back(y);
            for (int x = rect.x / kTileSize; x <= (rect.right() - 1) / kTileSize; ++x) {
                tiles.push_back(y * mTilesX + x);
            }
        }
    }
    const auto dropRepeated = [](std::vector<int>& indices) {
        std::sort(indices.begin(), indices.end());
        indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    };
    dropRepeated(tiles);
    dropRepeated(rows);

    // Tiles, and rows of tiles, are summed in a fixed order: the same bits whatever the number of
    // cores.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 4),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              sumTile(map, effectiveRadiusMm, tiles[i]);
                          }
                      });
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
        std::vector<double>& sum = mRowSums[static_cast<std::size_t>(rows[i])];
        sum.assign(kSamples, 0.0);
        for (int x = 0; x < mTilesX; ++x) {
            const Sum& tile = mTiles[static_cast<std::size_t>(rows[i] * mTilesX + x)];
            for (std::size_t s = 0; s < kSamples; ++s) {
                sum[s] += static_cast<double>(tile[s]);
            }
        }
    });
}

void MeanProfileSums::sumTile(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                              int tile) {
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const int left = tile % mTilesX * kTileSize;
    const int top = tile / mTilesX * kTileSize;
    Sum& sum = mTiles[static_cast<std::size_t>(tile)];
    sum.fill(0.0f);
    Sum samples;
    TexelSampler sampler;
    for (int y = top; y < std::min(map.height, top + kTileSize); ++y) {
        for (int x = left; x < std::min(map.width, left + kTileSize); ++x) {
            const std::size_t texel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(x);
            const float samplesPerSegment = h / effectiveRadiusMm[texel] * kMeanProfileIntervals;
            sampler.sample(map.logProfile.data() + texel * stride, map.segments, samplesPerSegment,
                           samples);
            const float scale = 1.0f / std::max(trapezoidEnergy(samples), 1e-30f);
            addScaled(samples.data(), scale, sum.data());
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
