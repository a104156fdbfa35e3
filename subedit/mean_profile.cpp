#include "subedit/mean_profile.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"
#include "subedit/multiversion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

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

/// A run of samples on which the channels fall or rise by a constant factor from one to the next.
struct Run {
    int end;        ///< where the next one begins
    float start[3]; ///< ln P of the channels at its first sample
    float slope[3]; ///< what it changes by to the next sample
};

/// Fills in the samples of runs, the channels summed, and measures them.
/// @param runs    the last ends at kSamples or before: what follows is zero
/// @param samples kPadded values
/// @return        sum of sample times index
CELADON_MULTIVERSION float fillRuns(const Run* __restrict runs, int count,
                                    float* __restrict samples) {
    float indexed = 0.0f;
    int i = 0;
    for (const Run* run = runs; run != runs + count; ++run) {
        // P at eight samples at once, and the factor to the next eight.
        alignas(32) float p[3][kLanes];
        float step[3];
        for (int c = 0; c < 3; ++c) {
            for (int j = 0; j < kLanes; ++j) {
                p[c][j] = fastExp(run->start[c] + run->slope[c] * static_cast<float>(j));
            }
            step[c] = fastExp(run->slope[c] * kLanes);
        }
        float total[kLanes] = {};
        const int last = run->end;
        for (; i + kLanes <= last; i += kLanes) {
            for (int j = 0; j < kLanes; ++j) {
                const float sum = p[0][j] + p[1][j] + p[2][j];
                samples[i + j] = sum;
                total[j] += sum * static_cast<float>(i + j);
                p[0][j] *= step[0];
                p[1][j] *= step[1];
                p[2][j] *= step[2];
            }
        }
        for (int j = 0; i < last; ++i, ++j) {
            const float sum = p[0][j] + p[1][j] + p[2][j];
            samples[i] = sum;
            indexed += sum * static_cast<float>(i);
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
/// samples of ln P are equally spaced: P is multiplied by a constant from one to the next, and few
/// exponentials are needed.
class TexelSampler {
public:
    /// Adds C P, C such that the integral of P r dr over [0, 1] is 1 (by trapezoids: exact enough
    /// for a weight).
    void add(const float* logProfile, int segments, float samplesPerSegment, float* sum) {
        const int count = layOut(logProfile, segments, samplesPerSegment);
        float indexed = fillRuns(mRuns.data(), count, mSamples.data());
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
            Run& run = mRuns[static_cast<std::size_t>(used++)];
            for (int channel = 0; channel < 3; ++channel) {
                const float slope = logProfile[3 + channel] - logProfile[channel];
                run.start[channel] = logProfile[channel] + slope * t;
                run.slope[channel] = slope * segmentsPerSample;
            }
            run.end = end;
            i = end;
        }
        return used;
    }

    std::array<Run, kMaxSegments> mRuns;
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
      mTiles(static_cast<std::size_t>(mTilesX) * static_cast<std::size_t>(mTilesY)),
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
                              const TexelRect tile = tileRect(map, tiles[i]);
                              if (beforeTile) {
                                  beforeTile(tile);
                              }
                              sumTile(map, effectiveRadiusMm, tile,
                                      mTiles[static_cast<std::size_t>(tiles[i])]);
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

TexelRect MeanProfileSums::tileRect(const MaterialMap& map, int tile) const {
    const int x = tile % mTilesX * kTileSize;
    const int y = tile / mTilesX * kTileSize;
    return {x, y, std::min(map.width - x, kTileSize), std::min(map.height - y, kTileSize)};
}

void MeanProfileSums::sumTile(const MaterialMap& map, std::span<const float> effectiveRadiusMm,
                              const TexelRect& rect, Sum& result) {
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    alignas(32) SampleArray sum{};
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
