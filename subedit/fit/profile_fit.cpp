#include "subedit/fit/profile_fit.h"

#include "subedit/assert.h"
#include "subedit/log_linear.h"
#include "subedit/map/material_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

constexpr int kSamplesPerSegment = 16;
constexpr double kBlackTotal = 1e-9; ///< of the floor's own order
constexpr double kFloor = kLogProfileFloor;
constexpr double kMaxLog = 40.0; ///< the reader's limit on ln P

struct Sample {
    double t;      ///< position in its segment
    double logP;   ///< floored
    double weight; ///< energy density P r
};

/// Midpoints of equal parts of every segment; r = 0, where P may be infinite, is not among them.
std::vector<Sample> sampleCurve(const RadialCurve& curve, int segments, double h) {
    std::vector<Sample> samples;
    samples.reserve(static_cast<std::size_t>(segments) * kSamplesPerSegment);
    for (int k = 0; k < segments; ++k) {
        for (int j = 0; j < kSamplesPerSegment; ++j) {
            const double t = (j + 0.5) / kSamplesPerSegment;
            const double r = (k + t) * h;
            const double logP = std::max(std::log(std::max(curve.reflectance(r), 1e-300)), kFloor);
            samples.push_back({t, logP, std::exp(logP) * r});
        }
    }
    return samples;
}

/// Minimizes the weighted squares of sum_k knot_k hat_k(r) - ln P(r): a tridiagonal system.
/// @param first segment that is looked at; knots before it get the value of its start
void solveLeastSquares(const std::vector<Sample>& samples, int segments, int first, double* knots) {
    const auto count = static_cast<std::size_t>(segments) + 1;
    std::vector<double> diagonal(count, 0.0);
    std::vector<double> upper(count, 0.0);
    std::vector<double> right(count, 0.0);
    double largest = 0.0;
    for (const Sample& sample : samples) {
        largest = std::max(largest, sample.weight);
    }
    for (std::size_t i = static_cast<std::size_t>(first) * kSamplesPerSegment; i < samples.size();
         ++i) {
        const Sample& sample = samples[i];
        const std::size_t k = i / kSamplesPerSegment;
        // Far out, where next to nothing is left, the shape still follows the curve.
        const double weight = std::max(sample.weight / largest, 1e-12);
        const double a = 1.0 - sample.t;
        const double b = sample.t;
        diagonal[k] += weight * a * a;
        diagonal[k + 1] += weight * b * b;
        upper[k] += weight * a * b;
        right[k] += weight * a * sample.logP;
        right[k + 1] += weight * b * sample.logP;
    }
    const auto start = static_cast<std::size_t>(first);
    for (std::size_t k = start + 1; k < count; ++k) {
        const double factor = upper[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * upper[k - 1];
        right[k] -= factor * right[k - 1];
    }
    knots[count - 1] = right[count - 1] / diagonal[count - 1];
    for (std::size_t k = count - 1; k-- > start;) {
        knots[k] = (right[k] - upper[k] * knots[k + 1]) / diagonal[k];
    }
    std::fill_n(knots, start, knots[start]);
}

/// Least squares ring beside a peak much narrower than a segment: no knot but the first may leave
/// the curve by more than this.
void limitRinging(const RadialCurve& curve, int segments, double h, double* knots) {
    constexpr double kMaxDeviation = 0.5;
    knots[0] = std::clamp(knots[0], kFloor, kMaxLog);
    for (int k = 1; k <= segments; ++k) {
        const double logP = std::log(std::max(curve.reflectance(k * h), 1e-300));
        knots[k] = std::clamp(knots[k], logP - kMaxDeviation, logP + kMaxDeviation);
        knots[k] = std::clamp(knots[k], kFloor, kMaxLog);
    }
}

/// Adds one number to all knots, as far as the floor lets it, so that the energy is `target`.
void shiftToEnergy(double* knots, int segments, double h, double target) {
    const auto shifted = [&](int k, double shift) {
        return std::clamp(knots[k] + shift, kFloor, kMaxLog);
    };
    double low = kFloor - kMaxLog;
    double high = kMaxLog - kFloor;
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double middle = 0.5 * (low + high);
        double energy = 0.0;
        for (int k = 0; k < segments; ++k) {
            energy += pieceEnergy(shifted(k, middle), shifted(k + 1, middle), k * h, h);
        }
        (energy < target ? low : high) = middle;
    }
    for (int k = 0; k <= segments; ++k) {
        knots[k] = shifted(k, low);
    }
}

/// Sets the first knot, and only if that cannot do it shifts all, so that the energy is `target`.
void matchEnergy(double* knots, int segments, double h, double target) {
    double rest = 0.0;
    for (int k = 1; k < segments; ++k) {
        rest += pieceEnergy(knots[k], knots[k + 1], k * h, h);
    }
    const auto first = [&](double logStart) { return pieceEnergy(logStart, knots[1], 0.0, h); };
    double low = kFloor;
    double high = kMaxLog;
    if (rest + first(low) > target || rest + first(high) < target) {
        shiftToEnergy(knots, segments, h, target);
        return;
    }
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double middle = 0.5 * (low + high);
        (rest + first(middle) < target ? low : high) = middle;
    }
    knots[0] = 0.5 * (low + high);
}

double rmsLogError(const std::vector<Sample>& samples, const double* knots) {
    double error = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t k = i / kSamplesPerSegment;
        const Sample& sample = samples[i];
        const double fitted = knots[k] + (knots[k + 1] - knots[k]) * sample.t;
        error += sample.weight * (fitted - sample.logP) * (fitted - sample.logP);
        total += sample.weight;
    }
    return std::sqrt(error / total);
}

} // namespace

double chooseMaxRadiusMm(const RadialCurves& curves, const FitSettings& settings) {
    if (settings.maxRadiusMm > 0.0) {
        return settings.maxRadiusMm;
    }
    double radius = 0.0;
    for (const RadialCurve& curve : curves) {
        radius = std::max(radius, radiusHolding(curve, settings.heldEnergy));
    }
    return radius > 0.0 ? radius : 1.0;
}

double fitChannel(const RadialCurve& curve, int segments, double maxRadiusMm, double* logKnots,
                  PeakFit peak) {
    const double target = curve.total / (2.0 * std::numbers::pi);
    // What the floor itself holds; a curve below it is black.
    const double h = maxRadiusMm / segments;
    if (target <= std::exp(kFloor) * maxRadiusMm * maxRadiusMm) {
        std::fill_n(logKnots, segments + 1, kFloor);
        return 0.0;
    }
    const std::vector<Sample> samples = sampleCurve(curve, segments, h);
    // A peak that is infinite at r = 0 would bend the knots around its segment: the others do
    // without it, and the first knot follows from the energy.
    const bool isApart =
        peak == PeakFit::Apart && segments > 1 && std::isinf(curve.reflectance(0.0));
    solveLeastSquares(samples, segments, isApart ? 1 : 0, logKnots);
    limitRinging(curve, segments, h, logKnots);
    matchEnergy(logKnots, segments, h, target);
    return rmsLogError(samples, logKnots);
}

FittedProfile fitProfile(const RadialCurves& curves, const FitSettings& settings) {
    CELADON_ASSERT(settings.segments >= 1 && settings.segments <= kMaxSegments);
    const double maxRadiusMm = chooseMaxRadiusMm(curves, settings);
    FittedProfile fitted;
    fitted.segments = settings.segments;
    fitted.maxRadiusMm = static_cast<float>(maxRadiusMm);
    const auto knots = static_cast<std::size_t>(settings.segments) + 1;
    fitted.logProfile.resize(knots * 3);
    std::vector<double> channelKnots(knots);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        fitted.rmsLogError[static_cast<int>(channel)] =
            fitChannel(curves[channel], settings.segments, maxRadiusMm, channelKnots.data());
        for (std::size_t k = 0; k < knots; ++k) {
            fitted.logProfile[k * 3 + channel] = static_cast<float>(channelKnots[k]);
        }
    }
    return fitted;
}

namespace {

double rmsLogOutside(const RadialCurve& curve, const FittedProfile& fitted, int channel) {
    const double h = static_cast<double>(fitted.maxRadiusMm) / fitted.segments;
    double error = 0.0;
    double total = 0.0;
    const std::vector<Sample> samples = sampleCurve(curve, fitted.segments, h);
    for (std::size_t i = kSamplesPerSegment; i < samples.size(); ++i) {
        const auto k = static_cast<int>(i / kSamplesPerSegment);
        const auto knot = [&](int index) {
            return static_cast<double>(
                fitted.logProfile[static_cast<std::size_t>(index * 3 + channel)]);
        };
        const double stored = knot(k) + (knot(k + 1) - knot(k)) * samples[i].t;
        error += samples[i].weight * (stored - samples[i].logP) * (stored - samples[i].logP);
        total += samples[i].weight;
    }
    return total > 0.0 ? std::sqrt(error / total) : 0.0;
}

} // namespace

FitError measureFit(const RadialCurves& curves, const FittedProfile& fitted) {
    FitError error;
    error.rmsLog = fitted.rmsLogError;
    error.albedo = diffuseAlbedo(fitted.view());
    for (int channel = 0; channel < 3; ++channel) {
        const RadialCurve& curve = curves[static_cast<std::size_t>(channel)];
        error.albedo[channel] -= curve.total;
        if (curve.total <= kBlackTotal) {
            continue;
        }
        error.rmsLogOutside[channel] = rmsLogOutside(curve, fitted, channel);
        constexpr int kRadii = 128;
        for (int i = 1; i < kRadii; ++i) {
            // Denser near the center, where the energy is.
            const double t = static_cast<double>(i) / kRadii;
            const double r = static_cast<double>(fitted.maxRadiusMm) * t * t;
            const double stored = 2.0 * std::numbers::pi * radialEnergy(fitted.view(), r)[channel];
            error.misplaced[channel] = std::max(
                error.misplaced[channel], std::abs(stored - curve.energyWithin(r)) / curve.total);
        }
    }
    return error;
}

FittedProfile fitProfileWithin(const RadialCurves& curves, double tolerance, FitSettings settings) {
    FittedProfile fitted;
    for (const int segments : {4, 6, 8, 12, 16, 20, 24, 32, 40, 48, 64, 80, 96, 128}) {
        settings.segments = segments;
        fitted = fitProfile(curves, settings);
        const FitError error = measureFit(curves, fitted);
        const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
        if (largest(error.rmsLogOutside) <= tolerance && largest(error.misplaced) <= tolerance) {
            break;
        }
    }
    return fitted;
}

} // namespace celadon::subedit
