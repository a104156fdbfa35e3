#include "renderer/reference/path_traced.h"

#include "renderer/reference/exitance_film.h"
#include "renderer/reference/light_source.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

/// Batches of a round run at once, each into a picture of its own; their spread gives the error.
constexpr int kBatchesPerRound = 8;
constexpr int kRounds = 8; ///< that the paths asked for are dealt to
constexpr int kLeastRoundsForNoise = 2;
constexpr std::uint64_t kMostPathsPerBatch = 1 << 14; ///< so that noise is looked at often
constexpr std::uint64_t kLeastPathsPerBatch = 64;

struct Batch {
    std::vector<glm::dvec3> exitance;
    FluxBalance flux;
};

/// One batch: a shifted R3 sequence (Roberts 2018) spreads the rays evenly over lights and beams.
Batch traceBatch(const LightSource& source, const MediumWalk& walk, const ExitanceFilm& film,
                 std::uint64_t paths, std::uint64_t seed, std::uint64_t number) {
    constexpr double kRoot = 1.22074408460575947536; // of x^4 = x + 1
    Batch batch;
    batch.exitance.assign(film.pixelCount(), glm::dvec3(0.0));
    Random random(seed, number);
    const glm::dvec3 shift(random.uniform(), random.uniform(), random.uniform());
    for (std::uint64_t i = 0; i < paths; ++i) {
        const double n = static_cast<double>(i);
        const glm::dvec3 step(n / kRoot, n / (kRoot * kRoot), n / (kRoot * kRoot * kRoot));
        const glm::dvec3 chosen = glm::fract(shift + step);
        std::optional<LightEntry> entry = source.sample(chosen.z, glm::dvec2(chosen));
        if (!entry) {
            continue;
        }
        entry->flux /= static_cast<double>(paths);
        batch.flux +=
            walk.follow(*entry, random, [&](const SurfacePoint& point, const glm::dvec3& flux) {
                if (const auto splat = film.project(point)) {
                    batch.exitance[splat->pixel] += flux * splat->perArea;
                }
            });
    }
    return batch;
}

/// Sums over the batches so far.
struct Sums {
    std::vector<glm::dvec3> values;
    std::vector<glm::dvec3> squares;
    FluxBalance flux;
    int batches = 0;

    void add(const Batch& batch) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] += batch.exitance[i];
            squares[i] += batch.exitance[i] * batch.exitance[i];
        }
        flux += batch.flux;
        ++batches;
    }

    /// Exitance, its standard error, and both together.
    [[nodiscard]] PathTracedResult result() const {
        PathTracedResult result;
        const double n = batches;
        double squaredError = 0.0;
        double squaredExitance = 0.0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const glm::dvec3 mean = values[i] / n;
            const glm::dvec3 variance =
                glm::max(squares[i] / n - mean * mean, glm::dvec3(0.0)) / (n - 1.0);
            result.exitance.emplace_back(mean);
            result.standardError.emplace_back(glm::sqrt(variance));
            squaredError += variance.x + variance.y + variance.z;
            squaredExitance += glm::dot(mean, mean);
        }
        if (squaredExitance > 0.0) {
            result.relativeError = std::sqrt(squaredError / squaredExitance);
        }
        for (glm::dvec3 FluxBalance::*part :
             {&FluxBalance::entered, &FluxBalance::left, &FluxBalance::lost}) {
            result.flux.*part = flux.*part / n;
        }
        return result;
    }
};

} // namespace

PathTraced::PathTraced(const World& world, const PathTracedSettings& settings)
    : mSettings(settings), mRays(world), mWalk(mRays, settings.medium) {}

PathTracedResult PathTraced::solve(const CameraView& camera, glm::ivec2 size,
                                   std::span<const Light> lights,
                                   const std::atomic<bool>* cancel) const {
    const LightSource source(mRays, lights, mWalk.medium().eta);
    const ExitanceFilm film(mRays, camera, size);
    const std::uint64_t perBatch = std::clamp(mSettings.paths / (kRounds * kBatchesPerRound),
                                              kLeastPathsPerBatch, kMostPathsPerBatch);
    const auto wanted = std::max<std::uint64_t>(
        1, (mSettings.paths + perBatch * kBatchesPerRound - 1) / (perBatch * kBatchesPerRound));
    Sums sums;
    sums.values.assign(film.pixelCount(), glm::dvec3(0.0));
    sums.squares = sums.values;
    PathTracedResult result;
    for (std::uint64_t round = 0; round < wanted; ++round) {
        std::array<Batch, kBatchesPerRound> batches;
        oneapi::tbb::parallel_for(0, kBatchesPerRound, [&](int i) {
            batches[static_cast<std::size_t>(i)] =
                traceBatch(source, mWalk, film, perBatch, mSettings.seed,
                           round * kBatchesPerRound + static_cast<std::uint64_t>(i));
        });
        for (const Batch& batch : batches) { // in one order, for the same bits
            sums.add(batch);
        }
        result = sums.result();
        result.paths = (round + 1) * kBatchesPerRound * perBatch;
        if (mSettings.progress) {
            mSettings.progress(result.paths, result.relativeError);
        }
        const bool isQuiet = mSettings.noise > 0.0 && round + 1 >= kLeastRoundsForNoise &&
                             result.relativeError <= mSettings.noise;
        // Nothing was seen of so many paths: there is no error that more could bring down.
        const bool isDark = mSettings.noise > 0.0 && !std::isfinite(result.relativeError) &&
                            result.paths >= PathTracedSettings().paths;
        if (isQuiet || isDark || (cancel != nullptr && *cancel)) {
            break;
        }
    }
    return result;
}

} // namespace celadon
