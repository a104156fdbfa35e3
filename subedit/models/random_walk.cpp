#include "subedit/models/random_walk.h"

#include "subedit/assert.h"
#include "subedit/models/half_space.h"
#include "subedit/models/walk_steps.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <random>

namespace celadon::subedit {

namespace {

/// Walks are dealt to this many batches, each with its own random numbers; the spread of the
/// batches gives the standard error.
constexpr std::int64_t kMostBatches = 256;

constexpr double kSmallestRadius = 0.004; ///< first ring, in the shortest transport mean free path
constexpr double kLargestRadius = 2e4;    ///< last edge, in the longest
constexpr double kBinsPerOctave = 8.0;

constexpr double kRouletteWeight = 0.1;
constexpr double kRouletteSurvival = 0.5;
/// A walk without absorption has no mean length. From this many steps on, and at each doubling, a
/// part of the walks ends so that each doubling costs the same.
constexpr std::int64_t kFirstLongWalk = 1024;
constexpr std::int64_t kLongestWalk = std::int64_t{1} << 26;

class Random {
public:
    Random(std::uint64_t seed, std::uint64_t batch) {
        std::seed_seq sequence{static_cast<std::uint32_t>(seed),
                               static_cast<std::uint32_t>(seed >> 32),
                               static_cast<std::uint32_t>(batch)};
        mGenerator.seed(sequence);
    }
    /// In [0, 1).
    double uniform() { return static_cast<double>(mGenerator() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 mGenerator;
};

/// What does not change during a simulation.
struct Setup {
    glm::dvec3 albedo;   ///< of one scattering event, sigma_s / sigma_t
    glm::dvec3 lengthMm; ///< 1 / sigma_t
    double g;
    double eta;
    LightEntry entry;
    double firstEdgeMm;
    int bins;
    /// log2 of squared edges, per channel for squared radii in its mean free paths
    glm::dvec3 logOffset;

    Setup(const Medium& medium, LightEntry theEntry)
        : g(medium.anisotropy), eta(medium.eta), entry(theEntry) {
        const glm::dvec3 scattering = medium.reducedScattering / (1.0 - g);
        const glm::dvec3 extinction = medium.absorption + scattering;
        albedo = scattering / extinction;
        lengthMm = 1.0 / extinction;
        const glm::dvec3 transport = 1.0 / medium.reducedExtinction();
        firstEdgeMm = kSmallestRadius * std::min({transport.x, transport.y, transport.z});
        const double lastMm = kLargestRadius * std::max({transport.x, transport.y, transport.z});
        bins = 1 + static_cast<int>(std::ceil(kBinsPerOctave * std::log2(lastMm / firstEdgeMm)));
        logOffset = 2.0 * glm::log2(lengthMm / firstEdgeMm);
    }

    /// Bin of a squared radius in mean free paths, `bins` for beyond.
    [[nodiscard]] int bin(int channel, double logSquared) const {
        const double position = 0.5 * kBinsPerOctave * (logSquared + logOffset[channel]);
        return position < 0.0 ? 0 : static_cast<int>(std::min(position + 1.0, 1.0 * bins));
    }
};

/// Energy of one batch by channel: its rings, beyond, and the total.
struct Tally {
    std::array<std::vector<double>, 3> energy;

    explicit Tally(int bins) {
        for (std::vector<double>& channel : energy) {
            channel.assign(static_cast<std::size_t>(bins) + 1, 0.0);
        }
    }
    void add(const Setup& setup, double squaredRadius, const glm::dvec3& weight) {
        const double logSquared = squaredRadius > 0.0 ? std::log2(squaredRadius) : -1e9;
        for (int channel = 0; channel < 3; ++channel) {
            energy[static_cast<std::size_t>(channel)]
                  [static_cast<std::size_t>(setup.bin(channel, logSquared))] += weight[channel];
        }
    }
};

/// @return whether the walk goes on, at a higher weight
bool surviveRoulette(glm::dvec3& weight, double survival, Random& random) {
    if (random.uniform() >= survival) {
        return false;
    }
    weight /= survival;
    return true;
}

void walk(const Setup& setup, Random& random, Tally& tally) {
    glm::dvec3 position(0.0); // z is the depth
    glm::dvec3 direction(0.0, 0.0, 1.0);
    if (setup.entry == LightEntry::Diffuse) {
        const double squared = pointInDisk(random, direction.x, direction.y);
        direction.z = std::sqrt(1.0 - squared);
    }
    glm::dvec3 weight(1.0);
    std::int64_t nextDoubling = kFirstLongWalk;
    for (std::int64_t step = 1; step < kLongestWalk; ++step) {
        double length = freePath(random);
        while (direction.z < 0.0 && -direction.z * length > position.z) {
            const double cosine = -direction.z;
            const double toSurface = position.z / cosine;
            position += toSurface * direction;
            position.z = 0.0;
            const double reflectance =
                setup.eta == 1.0 ? 0.0 : fresnelReflectance(cosine, 1.0 / setup.eta);
            if (reflectance < 1.0) {
                tally.add(setup, position.x * position.x + position.y * position.y,
                          weight * (1.0 - reflectance));
                weight *= reflectance;
            }
            if (reflectance == 0.0) {
                return;
            }
            length -= toSurface;
            direction.z = cosine;
        }
        position += length * direction;
        weight *= setup.albedo;
        if (std::max({weight.x, weight.y, weight.z}) < kRouletteWeight &&
            !surviveRoulette(weight, kRouletteSurvival, random)) {
            return;
        }
        if (step == nextDoubling) {
            nextDoubling *= 2;
            if (!surviveRoulette(weight, 1.0 / std::numbers::sqrt2, random)) {
                return;
            }
        }
        direction = scatter(direction, setup.g, random);
    }
}

/// Mean and standard error of the batches' values, each divided by its number of walks.
class BatchStatistics {
public:
    void add(double value) {
        ++mCount;
        const double change = value - mMean; // Welford 1962
        mMean += change / mCount;
        mSquares += change * (value - mMean);
    }
    [[nodiscard]] double mean() const { return mMean; }
    [[nodiscard]] double error() const {
        return mCount > 1.0 ? std::sqrt(mSquares / (mCount * (mCount - 1.0))) : mMean;
    }

private:
    double mCount = 0.0;
    double mMean = 0.0;
    double mSquares = 0.0;
};

RadialHistogram summarize(const std::vector<Tally>& tallies, std::size_t channel, int bins,
                          double walksPerBatch) {
    RadialHistogram histogram;
    for (std::size_t bin = 0; bin < static_cast<std::size_t>(bins); ++bin) {
        BatchStatistics statistics;
        for (const Tally& tally : tallies) {
            statistics.add(tally.energy[channel][bin] / walksPerBatch);
        }
        histogram.energy.push_back(statistics.mean());
        histogram.error.push_back(statistics.error());
    }
    BatchStatistics total;
    for (const Tally& tally : tallies) {
        double sum = 0.0;
        for (const double energy : tally.energy[channel]) {
            sum += energy;
        }
        total.add(sum / walksPerBatch);
    }
    histogram.total = total.mean();
    histogram.totalError = total.error();
    return histogram;
}

} // namespace

double RandomWalkResult::radiusMm(std::size_t bin) const {
    // Within the first ring P goes like 1/r: its mean over the disk is the value at half the edge.
    return bin == 0 ? 0.5 * edgesMm[1] : std::sqrt(edgesMm[bin] * edgesMm[bin + 1]);
}

double RandomWalkResult::reflectance(int channel, std::size_t bin) const {
    const double area =
        std::numbers::pi * (edgesMm[bin + 1] * edgesMm[bin + 1] - edgesMm[bin] * edgesMm[bin]);
    return channels[static_cast<std::size_t>(channel)].energy[bin] / area;
}

double RandomWalkResult::reflectanceError(int channel, std::size_t bin) const {
    const double area =
        std::numbers::pi * (edgesMm[bin + 1] * edgesMm[bin + 1] - edgesMm[bin] * edgesMm[bin]);
    return channels[static_cast<std::size_t>(channel)].error[bin] / area;
}

RandomWalkResult simulateRandomWalk(const Medium& medium, const RandomWalkSettings& settings) {
    CELADON_ASSERT(settings.walks >= 1);
    const Setup setup(medium, settings.entry);
    // All batches have as many walks, so that each counts alike: a few more than asked for.
    const std::int64_t batches = std::min(kMostBatches, settings.walks);
    const std::int64_t walksPerBatch = (settings.walks + batches - 1) / batches;
    std::vector<Tally> tallies(static_cast<std::size_t>(batches), Tally(setup.bins));
    std::mutex mutex;
    std::int64_t done = 0;
    tbb::parallel_for(std::int64_t{0}, batches, [&](std::int64_t batch) {
        Random random(settings.seed, static_cast<std::uint64_t>(batch));
        for (std::int64_t i = 0; i < walksPerBatch; ++i) {
            walk(setup, random, tallies[static_cast<std::size_t>(batch)]);
        }
        if (settings.onProgress) {
            const std::lock_guard lock(mutex);
            settings.onProgress(static_cast<double>(++done) / static_cast<double>(batches));
        }
    });

    RandomWalkResult result;
    result.edgesMm.push_back(0.0);
    for (int bin = 0; bin < setup.bins; ++bin) {
        result.edgesMm.push_back(setup.firstEdgeMm * std::exp2(bin / kBinsPerOctave));
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        result.channels[channel] =
            summarize(tallies, channel, setup.bins, static_cast<double>(walksPerBatch));
    }
    return result;
}

} // namespace celadon::subedit
