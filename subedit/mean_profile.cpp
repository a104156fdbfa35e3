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
/// Samples are made and summed this many at a time; arrays of them are padded to a whole number.
constexpr int kLanes = 8;
constexpr int kPadded = (kSamples + kLanes - 1) / kLanes * kLanes;
using SampleArray = std::array<float, kPadded>;

/// Integral of P r dr over [start, start + width] for P linear from p0 to p1.
double linearEnergy(double p0, double p1, double start, double width) {
    return width * (start * 0.5 * (p0 + p1) + width * (p0 / 6.0 + p1 / 3.0));
}

/// e^x of all that runs begin with and change by.
CELADON_MULTIVERSION void exponentials(float* __restrict values, int count) {
    for (int i = 0; i < count; ++i) {
        values[i] = fastExp(values[i]);
    }
}

/// Fills in the samples of runs, the channels summed, and measures them. On a run the channels
/// change by a constant factor from one sample to the next.
/// @param start   of each run: P of the channels at its first sample, then those factors
/// @param end     of each run; the last ends at kSamples or before: what follows is zero
/// @param samples kPadded values
/// @return        sum of sample times index
CELADON_MULTIVERSION float fillRuns(const float* __restrict start, const int* __restrict end,
                                    int runs, float* __restrict samples) {
    float indexed = 0.0f;
    int i = 0;
    for (int run = 0; run < runs; ++run, start += 6) {
        // P at eight samples at once, and the factor to the next eight: one after the other each
        // product would wait for the one before.
        Eight p[3];
        Eight step[3];
        for (int c = 0; c < 3; ++c) {
            const float ratio = start[3 + c];
            const float r2 = ratio * ratio;
            const float r3 = r2 * ratio;
            const float r4 = r2 * r2;
            p[c] = Eight{1.0f, ratio, r2, r3, r4, r4 * ratio, r4 * r2, r4 * r3} * start[c];
            step[c] = Eight{} + r4 * r4;
        }
        const int last = end[run];
        Eight index = Eight{0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f} + static_cast<float>(i);
        Eight total{};
        for (; i + kLanes <= last; i += kLanes) {
            const Eight sum = p[0] + p[1] + p[2];
            std::memcpy(samples + i, &sum, sizeof(sum));
            total += sum * index;
            index += static_cast<float>(kLanes);
            for (int c = 0; c < 3; ++c) {
                p[c] *= step[c];
            }
        }
        const Eight sum = p[0] + p[1] + p[2];
        for (int j = 0; i < last; ++i, ++j) {
            samples[i] = sum[j];
            indexed += sum[j] * static_cast<float>(i);
        }
        indexed += ((total[0] + total[4]) + (total[1] + total[5])) +
                   ((total[2] + total[6]) + (total[3] + total[7]));
    }
    for (; i < kPadded; ++i) {
        samples[i] = 0.0f; // beyond r_s
    }
    return indexed;
}

CELADON_MULTIVERSION void addScaled(const float* __restrict samples, float scale,
                                    float* __restrict sum) {
    for (int i = 0; i < kPadded; ++i) {
        sum[i] += samples[i] * scale;
    }
}

/// Samples the summed channels of texels at r_i = i / N in units of R_P. Within a segment the
/// samples of ln P are equally spaced: P is multiplied by a constant from one to the next, and two
/// exponentials per segment and channel are enough.
class TexelSampler {
public:
    /// Adds C P, C such that the integral of P r dr over [0, 1] is 1 (by trapezoids: exact enough
    /// for a weight).
    void add(const float* logProfile, int segments, float samplesPerSegment, float* sum) {
        const int count = layOut(logProfile, segments, samplesPerSegment);
        exponentials(mStart.data(), count * 6);
        float indexed = fillRuns(mStart.data(), mEnd.data(), count, mSamples.data());
        indexed -= 0.5f * mSamples[kMeanProfileIntervals] * kMeanProfileIntervals;
        constexpr float kPerIndex =
            1.0f / (static_cast<float>(kMeanProfileIntervals) * kMeanProfileIntervals);
        addScaled(mSamples.data(), 1.0f / std::max(indexed * kPerIndex, 1e-30f), sum);
    }

private:
    /// A run for each segment that has samples at all. @return their number
    int layOut(const float* logProfile, int segments, float samplesPerSegment) {
        const float segmentsPerSample = 1.0f / samplesPerSegment;
        int used = 0;
        int i = 0;
        for (int k = 0; k < segments && i < kSamples; ++k, logProfile += 3) {
            const float border = static_cast<float>(k + 1) * samplesPerSegment;
            int end = kSamples;
            if (border < static_cast<float>(kSamples)) {
                end = static_cast<int>(border);
                end += static_cast<float>(end) < border ? 1 : 0;
            }
            if (i >= end) {
                continue;
            }
            const float t = static_cast<float>(i) * segmentsPerSample - static_cast<float>(k);
            float* start = mStart.data() + used * 6;
            for (int channel = 0; channel < 3; ++channel) {
                const float slope = logProfile[3 + channel] - logProfile[channel];
                start[channel] = logProfile[channel] + slope * t;
                start[3 + channel] = slope * segmentsPerSample;
            }
            mEnd[static_cast<std::size_t>(used++)] = end;
            i = end;
        }
        return used;
    }

    std::array<float, kMaxSegments * 6> mStart; ///< logarithms, then what they are the logs of
    std::array<int, kMaxSegments> mEnd;
    SampleArray mSamples;
};

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
      mSpansX((mTilesX + kSpanTiles - 1) / kSpanTiles),
      mTiles(static_cast<std::size_t>(mTilesX) * static_cast<std::size_t>(mTilesY)),
      mSpanSums(static_cast<std::size_t>(mSpansX) * static_cast<std::size_t>(mTilesY),
                std::vector<double>(kSamples)),
      mRowSums(static_cast<std::size_t>(mTilesY), std::vector<double>(kSamples)) {
    const TexelRect whole{0, 0, map.width, map.height};
    update(map, effectiveRadiusMm, {&whole, 1});
}

void MeanProfileSums::update(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                             std::span<const TexelRect> rects,
                             const std::function<void(const TexelRect&)>& beforeTile) {
    CELADON_ASSERT(effectiveRadiusMm.size() ==
                   static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    std::vector<int> tiles;
    std::vector<int> spans;
    std::vector<int> rows;
    for (const TexelRect& rect : rects) {
        if (rect.isEmpty()) {
            continue;
        }
        for (int y = rect.y / kTileSize; y <= (rect.bottom() - 1) / kTileSize; ++y) {
            rows.push_back(y);
            for (int x = rect.x / kTileSize; x <= (rect.right() - 1) / kTileSize; ++x) {
                tiles.push_back(y * mTilesX + x);
                spans.push_back(y * mSpansX + x / kSpanTiles);
            }
        }
    }
    const auto dropRepeated = [](std::vector<int>& indices) {
        std::sort(indices.begin(), indices.end());
        indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    };
    dropRepeated(tiles);
    dropRepeated(spans);
    dropRepeated(rows);

    // Tiles, spans and rows are summed in a fixed order: the same bits whatever the number of
    // cores.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 4),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              const TexelRect tile = tileRect(map, tiles[i]);
                              if (beforeTile) {
                                  beforeTile(tile);
                              }
                              sumTile(map, effectiveRadiusMm, tile,
                                      mTiles[static_cast<std::size_t>(tiles[i])]);
                          }
                      });
    const auto add = [](const auto& part, std::vector<double>& sum) {
        for (std::size_t s = 0; s < kSamples; ++s) {
            sum[s] += static_cast<double>(part[s]);
        }
    };
    tbb::parallel_for(std::size_t{0}, spans.size(), [&](std::size_t i) {
        std::vector<double>& sum = mSpanSums[static_cast<std::size_t>(spans[i])];
        sum.assign(kSamples, 0.0);
        const int row = spans[i] / mSpansX * mTilesX;
        const int first = spans[i] % mSpansX * kSpanTiles;
        for (int x = first; x < std::min(first + kSpanTiles, mTilesX); ++x) {
            add(mTiles[static_cast<std::size_t>(row + x)], sum);
        }
    });
    for (const int row : rows) {
        std::vector<double>& sum = mRowSums[static_cast<std::size_t>(row)];
        sum.assign(kSamples, 0.0);
        for (int x = 0; x < mSpansX; ++x) {
            add(mSpanSums[static_cast<std::size_t>(row * mSpansX + x)], sum);
        }
    }
}

TexelRect MeanProfileSums::tileRect(const MaterialMap& map, int tile) const {
    const int x = tile % mTilesX * kTileSize;
    const int y = tile / mTilesX * kTileSize;
    return {x, y, std::min(map.width - x, kTileSize), std::min(map.height - y, kTileSize)};
}

void MeanProfileSums::sumTile(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                              const TexelRect& rect, Sum& result) {
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    SampleArray sum{};
    TexelSampler sampler;
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            const std::size_t texel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                static_cast<std::size_t>(x);
            const float samplesPerSegment = h / effectiveRadiusMm[texel] * kMeanProfileIntervals;
            sampler.add(map.logProfile.data() + texel * stride, map.segments, samplesPerSegment,
                        sum.data());
        }
    }
    std::copy_n(sum.begin(), kSamples, result.begin());
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
