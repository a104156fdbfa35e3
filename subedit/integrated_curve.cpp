#include "subedit/integrated_curve.h"

#include "subedit/models/gauss_legendre.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace celadon::subedit {

namespace {

constexpr double kReach = 1e6;
constexpr int kPanels = 64;
constexpr int kNodes = 8;

class CumulativeEnergy {
public:
    CumulativeEnergy(const std::function<double(double)>& reflectance, double lengthMm)
        : mReflectance(reflectance),
          mFirst(std::log(lengthMm / kReach)),
          mWidth(2.0 * std::log(kReach) / kPanels) {
        appendGaussLegendre(mNodes, 0.0, 1.0, kNodes);
        mInnerSlope = slopeAt(mFirst + 0.5 * mWidth);
        // P r^2 / (slope + 2): what lies inside of a power law that is not too steep.
        mEnergy.push_back(density(mFirst) / std::max(mInnerSlope + 2.0, 0.1));
        for (int panel = 0; panel < kPanels; ++panel) {
            mEnergy.push_back(mEnergy.back() + panelEnergy(panel, 1.0));
        }
        const double last = mFirst + mWidth * kPanels;
        const double atEnd = density(last);
        mTotal = mEnergy.back();
        if (atEnd > 0.0) {
            mTotal += atEnd / std::max(-slopeAt(last - 0.5 * mWidth) - 2.0, 0.1);
        }
    }

    [[nodiscard]] double within(double r) const {
        if (!(r > 0.0)) {
            return 0.0;
        }
        const double position = (std::log(r) - mFirst) / mWidth;
        if (position <= 0.0) {
            return mEnergy.front() * std::exp((mInnerSlope + 2.0) * position * mWidth);
        }
        if (position >= kPanels) {
            return mTotal;
        }
        const int panel = static_cast<int>(position);
        return mEnergy[static_cast<std::size_t>(panel)] + panelEnergy(panel, position - panel);
    }

    [[nodiscard]] double total() const { return mTotal; }

private:
    /// Energy per ln r, 2 pi P r^2.
    [[nodiscard]] double density(double logR) const {
        const double r = std::exp(logR);
        return 2.0 * std::numbers::pi * mReflectance(r) * r * r;
    }
    /// d ln P / d ln r
    [[nodiscard]] double slopeAt(double logR) const {
        constexpr double kStep = 0.05;
        const double before = density(logR - kStep);
        const double after = density(logR + kStep);
        return before > 0.0 && after > 0.0 ? std::log(after / before) / (2.0 * kStep) - 2.0 : 0.0;
    }
    [[nodiscard]] double panelEnergy(int panel, double part) const {
        double sum = 0.0;
        for (const QuadratureNode& node : mNodes) {
            sum += node.weight * density(mFirst + mWidth * (panel + part * node.position));
        }
        return sum * mWidth * part;
    }

    std::function<double(double)> mReflectance;
    double mFirst; ///< ln r of the first panel
    double mWidth; ///< of a panel, in ln r
    std::vector<QuadratureNode> mNodes;
    double mInnerSlope = 0.0;
    std::vector<double> mEnergy; ///< within the panels' borders
    double mTotal = 0.0;
};

} // namespace

RadialCurve integrateCurve(std::function<double(double)> reflectance, double lengthMm) {
    const auto energy = std::make_shared<const CumulativeEnergy>(reflectance, lengthMm);
    return {std::move(reflectance), [energy](double r) { return energy->within(r); },
            energy->total()};
}

} // namespace celadon::subedit
