#include "subedit/fit/response_fit.h"

#include "subedit/assert.h"
#include "subedit/errors.h"
#include "subedit/radius_map.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::subedit {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Triplet = Eigen::Triplet<double>;

constexpr double kSmallestWeight = 1e-3; ///< of a sample, relative to the largest response's
constexpr double kTether = 1e-6;         ///< keeps ln P that nothing determines from drifting

struct TexelTap {
    int texel;
    double weight;
};

/// The four texels around a repeating coordinate, as MaterialMap::sampleLogProfile() takes them.
std::array<TexelTap, 4> texelTaps(const glm::vec2& uv, int width, int height) {
    const auto axis = [](float t, int size) {
        const double wrapped = static_cast<double>(t) - std::floor(static_cast<double>(t));
        const double position = wrapped * size - 0.5;
        const double base = std::floor(position);
        const int first = static_cast<int>(base);
        return std::array<TexelTap, 2>{{{(first + size) % size, 1.0 - (position - base)},
                                        {(first + 1) % size, position - base}}};
    };
    const auto x = axis(uv.x, width);
    const auto y = axis(uv.y, height);
    std::array<TexelTap, 4> taps;
    for (std::size_t j = 0; j < 2; ++j) {
        for (std::size_t i = 0; i < 2; ++i) {
            taps[j * 2 + i] = {y[j].texel * width + x[i].texel, y[j].weight * x[i].weight};
        }
    }
    return taps;
}

class ResponseSystem {
public:
    ResponseSystem(std::span<const ResponseSample> samples, const ResponseFitSettings& settings,
                   double maxRadiusMm)
        : mSamples(samples),
          mSettings(settings),
          mMaxRadiusMm(maxRadiusMm),
          mKnots(settings.segments + 1) {}

    [[nodiscard]] int unknowns() const { return mSettings.width * mSettings.height * mKnots; }

    [[nodiscard]] bool isUsable(const ResponseSample& sample, int channel) const {
        return sample.response[channel] > 0.0f &&
               static_cast<double>(sample.distanceMm) <= mMaxRadiusMm;
    }

    /// ln P of all knots, [texel][knot], of one channel. @param touched texels are marked
    [[nodiscard]] Eigen::VectorXd solve(int channel, std::vector<char>& touched) const {
        std::vector<Triplet> triplets;
        std::vector<double> right;
        double largest = 0.0;
        double mean = 0.0;
        double count = 0.0;
        for (const ResponseSample& sample : mSamples) {
            if (isUsable(sample, channel)) {
                const double response = static_cast<double>(sample.response[channel]);
                largest = std::max(largest, response);
                mean += std::log(response);
                count += 1.0;
            }
        }
        if (count == 0.0) { // black
            return Eigen::VectorXd::Constant(unknowns(), static_cast<double>(kLogProfileFloor));
        }
        mean /= count;
        for (const ResponseSample& sample : mSamples) {
            if (isUsable(sample, channel)) {
                const double response = static_cast<double>(sample.response[channel]);
                const double weight = std::max(std::sqrt(response / largest), kSmallestWeight);
                addSample(sample, weight, triplets, static_cast<int>(right.size()), touched);
                right.push_back(weight * (std::log(response) - mean));
            }
        }
        // The smoothness of each unknown against the mean weight of the samples that it has.
        const double samplesPerUnknown = std::max(count / unknowns(), 1.0);
        addSmoothness(std::sqrt(samplesPerUnknown), triplets, right);
        Matrix matrix(static_cast<int>(right.size()), unknowns());
        matrix.setFromTriplets(triplets.begin(), triplets.end());
        const Eigen::Map<const Eigen::VectorXd> b(right.data(),
                                                  static_cast<Eigen::Index>(right.size()));
        Eigen::LeastSquaresConjugateGradient<Matrix> solver(matrix);
        solver.setMaxIterations(2000);
        solver.setTolerance(1e-8);
        Eigen::VectorXd x = solver.solve(b);
        return x.array() + mean;
    }

    /// ln R_d that profiles x give for a sample.
    [[nodiscard]] double predict(const ResponseSample& sample, const Eigen::VectorXd& x) const {
        double sum = 0.0;
        visit(sample, [&](int unknown, double weight) { sum += weight * x[unknown]; });
        return sum;
    }

private:
    /// The unknowns that ln R_d of a sample is made of, and their weights.
    template<typename Visit>
    void visit(const ResponseSample& sample, const Visit& take) const {
        const double position =
            static_cast<double>(sample.distanceMm) / mMaxRadiusMm * mSettings.segments;
        const int k = std::min(static_cast<int>(position), mSettings.segments - 1);
        const double t = position - k;
        for (const glm::vec2& uv : {sample.uvIn, sample.uvOut}) {
            for (const TexelTap& tap : texelTaps(uv, mSettings.width, mSettings.height)) {
                if (tap.weight > 0.0) {
                    take(tap.texel * mKnots + k, 0.5 * tap.weight * (1.0 - t));
                    take(tap.texel * mKnots + k + 1, 0.5 * tap.weight * t);
                }
            }
        }
    }

    void addSample(const ResponseSample& sample, double weight, std::vector<Triplet>& triplets,
                   int row, std::vector<char>& touched) const {
        visit(sample, [&](int unknown, double part) {
            triplets.emplace_back(row, unknown, weight * part);
            touched[static_cast<std::size_t>(unknown / mKnots)] = 1;
        });
    }

    void addSmoothness(double scale, std::vector<Triplet>& triplets,
                       std::vector<double>& right) const {
        const auto add = [&](std::initializer_list<std::pair<int, double>> terms, double weight) {
            const int row = static_cast<int>(right.size());
            for (const auto& [unknown, factor] : terms) {
                triplets.emplace_back(row, unknown, weight * factor);
            }
            right.push_back(0.0);
        };
        for (int y = 0; y < mSettings.height; ++y) {
            for (int x = 0; x < mSettings.width; ++x) {
                const int first = (y * mSettings.width + x) * mKnots;
                const int beside = (y * mSettings.width + (x + 1) % mSettings.width) * mKnots;
                const int below = ((y + 1) % mSettings.height * mSettings.width + x) * mKnots;
                for (int k = 0; k < mKnots; ++k) {
                    if (k > 0 && k + 1 < mKnots) {
                        add({{first + k - 1, 1.0}, {first + k, -2.0}, {first + k + 1, 1.0}},
                            scale * mSettings.radialSmoothness);
                    }
                    if (beside != first) {
                        add({{first + k, 1.0}, {beside + k, -1.0}},
                            scale * mSettings.spatialSmoothness);
                    }
                    if (below != first) {
                        add({{first + k, 1.0}, {below + k, -1.0}},
                            scale * mSettings.spatialSmoothness);
                    }
                    add({{first + k, 1.0}}, scale * kTether);
                }
            }
        }
    }

    std::span<const ResponseSample> mSamples;
    const ResponseFitSettings& mSettings;
    double mMaxRadiusMm;
    int mKnots;
};

/// Albedo above 1 is scaled to 1. @return number of texels that were
int clampAlbedo(MaterialMap& map) {
    const std::vector<float> albedo = albedoMap(map);
    const auto knots = static_cast<std::size_t>(map.knots());
    int clamped = 0;
    for (std::size_t texel = 0; texel * 3 < albedo.size(); ++texel) {
        bool isAbove = false;
        for (std::size_t c = 0; c < 3; ++c) {
            if (albedo[texel * 3 + c] <= 1.0f) {
                continue;
            }
            isAbove = true;
            const float shift = std::log(albedo[texel * 3 + c]);
            for (std::size_t k = 0; k < knots; ++k) {
                float& value = map.logProfile[(texel * knots + k) * 3 + c];
                value = std::max(value - shift, kLogProfileFloor);
            }
        }
        clamped += isAbove ? 1 : 0;
    }
    return clamped;
}

} // namespace

ResponseFit fitResponses(std::span<const ResponseSample> samples,
                         const ResponseFitSettings& settings) {
    CELADON_ASSERT(settings.width >= 1 && settings.height >= 1 && settings.segments >= 1);
    double maxRadiusMm = settings.maxRadiusMm;
    if (maxRadiusMm <= 0.0) {
        for (const ResponseSample& sample : samples) {
            maxRadiusMm = std::max(maxRadiusMm, static_cast<double>(sample.distanceMm));
        }
    }
    const ResponseSystem system(samples, settings, maxRadiusMm);
    ResponseFit fit;
    for (const ResponseSample& sample : samples) {
        const bool isUsed =
            maxRadiusMm > 0.0 && (system.isUsable(sample, 0) || system.isUsable(sample, 1) ||
                                  system.isUsable(sample, 2));
        ++(isUsed ? fit.used : fit.leftOut);
    }
    if (fit.used == 0) {
        throw InputError("responses", "no sample has a response above 0 at a distance up to r_s");
    }
    const auto texels =
        static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
    fit.map.name = "measured";
    fit.map.width = settings.width;
    fit.map.height = settings.height;
    fit.map.segments = settings.segments;
    fit.map.maxRadiusMm = static_cast<float>(maxRadiusMm);
    fit.map.logProfile.resize(static_cast<std::size_t>(system.unknowns()) * 3);
    std::array<std::vector<char>, 3> touched;
    std::array<Eigen::VectorXd, 3> logP;
    tbb::parallel_for(0, 3, [&](int channel) {
        const auto c = static_cast<std::size_t>(channel);
        touched[c].assign(texels, 0);
        logP[c] = system.solve(channel, touched[c]);
        for (int i = 0; i < system.unknowns(); ++i) {
            fit.map.logProfile[static_cast<std::size_t>(i) * 3 + c] = static_cast<float>(
                std::clamp(logP[c][i], static_cast<double>(kLogProfileFloor), 40.0));
        }
        double squares = 0.0;
        double sum = 0.0;
        double errors = 0.0;
        double responses = 0.0;
        for (const ResponseSample& sample : samples) {
            if (system.isUsable(sample, channel)) {
                const double response = static_cast<double>(sample.response[channel]);
                const double predicted = system.predict(sample, logP[c]);
                const double logError = predicted - std::log(response);
                squares += response * logError * logError;
                sum += response;
                errors += std::pow(std::exp(predicted) - response, 2);
                responses += response * response;
            }
        }
        fit.rmsLogError[channel] = sum > 0.0 ? std::sqrt(squares / sum) : 0.0;
        fit.relativeError[channel] = responses > 0.0 ? std::sqrt(errors / responses) : 0.0;
    });
    for (std::size_t texel = 0; texel < texels; ++texel) {
        fit.texelsWithout += touched[0][texel] || touched[1][texel] || touched[2][texel] ? 0 : 1;
    }
    fit.clamped = clampAlbedo(fit.map);
    return fit;
}

} // namespace celadon::subedit
