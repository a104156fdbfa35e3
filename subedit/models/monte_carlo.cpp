#include "subedit/models/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace celadon::subedit {

namespace {

constexpr double kMostNoise = 0.1;

class HistogramCurve {
public:
    HistogramCurve(const RandomWalkResult& result, std::size_t channel) {
        const RadialHistogram& histogram = result.channels[channel];
        mEdges.push_back(0.0);
        mWithin.push_back(0.0);
        double energy = 0.0;
        double variance = 0.0;
        for (std::size_t bin = 0; bin < result.bins(); ++bin) {
            energy += histogram.energy[bin];
            variance += histogram.error[bin] * histogram.error[bin];
            if (energy <= 0.0 || variance > kMostNoise * kMostNoise * energy * energy) {
                continue;
            }
            addRing(result.edgesMm[bin + 1], energy);
            energy = 0.0;
            variance = 0.0;
        }
        if (mLogP.empty() && energy > 0.0) { // next to no walks: one ring that holds them all
            std::size_t last = result.bins() - 1;
            while (histogram.energy[last] <= 0.0) {
                --last;
            }
            addRing(result.edgesMm[last + 1], energy);
        }
        mTotal = histogram.total;
        const std::size_t count = mLogP.size();
        if (count >= 2) {
            const double last = std::exp(mLogRadius[count - 1]);
            const double before = std::exp(mLogRadius[count - 2]);
            mTailSlope = std::min((mLogP[count - 1] - mLogP[count - 2]) / (last - before), 0.0);
        }
    }

    [[nodiscard]] double reflectance(double r) const {
        if (mLogP.empty()) {
            return 0.0;
        }
        if (r <= 0.0) {
            return std::numeric_limits<double>::infinity();
        }
        const double x = std::log(r);
        if (x <= mLogRadius.front()) {
            return std::exp(mLogP.front() + mLogRadius.front() - x); // like 1/r
        }
        if (x >= mLogRadius.back()) {
            return std::exp(mLogP.back() + mTailSlope * (r - std::exp(mLogRadius.back())));
        }
        const auto above = std::ranges::upper_bound(mLogRadius, x);
        const auto i = static_cast<std::size_t>(above - mLogRadius.begin()) - 1;
        const double t = (x - mLogRadius[i]) / (mLogRadius[i + 1] - mLogRadius[i]);
        return std::exp(mLogP[i] + (mLogP[i + 1] - mLogP[i]) * t);
    }

    /// Exact at the rings' edges, by a power of r between them.
    [[nodiscard]] double energyWithin(double r) const {
        if (!(r > 0.0) || mLogP.empty()) {
            return 0.0;
        }
        if (r >= mEdges.back()) {
            return mTotal + (mWithin.back() - mTotal) * std::exp(mTailSlope * (r - mEdges.back()));
        }
        const auto above = std::ranges::upper_bound(mEdges, r);
        const auto i = static_cast<std::size_t>(above - mEdges.begin()) - 1;
        const double energy = mWithin[i + 1] - mWithin[i];
        if (i == 0) {
            return energy * r / mEdges[1];
        }
        const double slope = (mLogP[i] - mLogP[i - 1]) / (mLogRadius[i] - mLogRadius[i - 1]) + 2.0;
        const double whole = std::log(mEdges[i + 1] / mEdges[i]);
        const double part = std::log(r / mEdges[i]);
        return mWithin[i] + energy * (std::abs(slope) < 1e-9
                                          ? part / whole
                                          : std::expm1(slope * part) / std::expm1(slope * whole));
    }

    [[nodiscard]] double total() const { return mTotal; }

private:
    void addRing(double to, double energy) {
        const double from = mEdges.back();
        const double r = from == 0.0 ? 0.5 * to : std::sqrt(from * to);
        mLogRadius.push_back(std::log(r));
        mLogP.push_back(std::log(energy / (std::numbers::pi * (to * to - from * from))));
        mEdges.push_back(to);
        mWithin.push_back(mWithin.back() + energy);
    }

    std::vector<double> mEdges;  ///< mm, of the joined rings
    std::vector<double> mWithin; ///< energy inside each edge
    std::vector<double> mLogRadius, mLogP;
    double mTailSlope = -1.0; ///< d ln P / dr beyond the last ring
    double mTotal = 0.0;
};

} // namespace

RadialCurves monteCarloProfile(const RandomWalkResult& result) {
    RadialCurves curves;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto curve = std::make_shared<const HistogramCurve>(result, channel);
        curves[channel] = {[curve](double r) { return curve->reflectance(r); },
                           [curve](double r) { return curve->energyWithin(r); }, curve->total()};
    }
    return curves;
}

} // namespace celadon::subedit
