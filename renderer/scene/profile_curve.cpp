#include "renderer/scene/profile_curve.h"

#include "subedit/assert.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace celadon {

namespace {

constexpr int kSamplesPerPiece = 128;

/// Second derivatives of the natural cubic spline, by elimination down a tridiagonal system.
std::vector<glm::dvec2> secondDerivatives(const std::vector<double>& t,
                                          const std::vector<glm::dvec2>& p) {
    const std::size_t count = p.size();
    std::vector<glm::dvec2> second(count, glm::dvec2(0.0));
    std::vector<double> upper(count, 0.0);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        const double before = t[i] - t[i - 1];
        const double after = t[i + 1] - t[i];
        const glm::dvec2 bend = 6.0 * ((p[i + 1] - p[i]) / after - (p[i] - p[i - 1]) / before);
        const double pivot = 2.0 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        second[i] = (bend - before * second[i - 1]) / pivot;
    }
    for (std::size_t i = count - 1; i-- > 1;) {
        second[i] -= upper[i] * second[i + 1];
    }
    return second;
}

} // namespace

ProfileCurve::ProfileCurve(const std::vector<glm::dvec2>& points) {
    CELADON_ASSERT(points.size() >= 2);
    std::vector<double> t(points.size(), 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        t[i] = t[i - 1] + std::sqrt(glm::distance(points[i], points[i - 1]));
    }
    const std::vector<glm::dvec2> second = secondDerivatives(t, points);
    mSamples.push_back(points.front());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double h = t[i + 1] - t[i];
        for (int k = 1; k <= kSamplesPerPiece; ++k) {
            const double b = static_cast<double>(k) / kSamplesPerPiece;
            const double a = 1.0 - b;
            mSamples.push_back(a * points[i] + b * points[i + 1] +
                               h * h / 6.0 *
                                   ((a * a * a - a) * second[i] + (b * b * b - b) * second[i + 1]));
        }
    }
    mLength.assign(mSamples.size(), 0.0);
    for (std::size_t i = 1; i < mSamples.size(); ++i) {
        mLength[i] = mLength[i - 1] + glm::distance(mSamples[i], mSamples[i - 1]);
    }
}

glm::dvec2 ProfileCurve::at(double arcLength) const {
    const auto after = std::upper_bound(mLength.begin(), mLength.end(), arcLength);
    if (after == mLength.begin()) {
        return mSamples.front();
    }
    if (after == mLength.end()) {
        return mSamples.back();
    }
    const auto i = static_cast<std::size_t>(after - mLength.begin());
    const double fraction = (arcLength - mLength[i - 1]) / (mLength[i] - mLength[i - 1]);
    return glm::mix(mSamples[i - 1], mSamples[i], fraction);
}

glm::dvec2 ProfileCurve::tangent(double arcLength) const {
    const double step = 1e-3 * length();
    const double low = std::clamp(arcLength - step, 0.0, length());
    const double high = std::clamp(arcLength + step, 0.0, length());
    return glm::normalize(at(high) - at(low));
}

double ProfileCurve::atHeight(double y) const {
    for (std::size_t i = 1; i < mSamples.size(); ++i) {
        const double a = mSamples[i - 1].y;
        const double b = mSamples[i].y;
        if ((a <= y && y < b) || (b <= y && y < a)) {
            return mLength[i - 1] + (y - a) / (b - a) * (mLength[i] - mLength[i - 1]);
        }
    }
    return y <= mSamples.front().y ? 0.0 : length();
}

} // namespace celadon
