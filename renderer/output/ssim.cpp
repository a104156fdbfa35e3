#include "renderer/output/ssim.h"

#include "renderer/output/separable_filter.h"
#include "subedit/assert.h"

namespace celadon {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01; // (K1 L)^2 with L = 1
constexpr double kC2 = 0.03 * 0.03;

/// A channel times a channel; the same one twice for a square.
Plane product(const FloatImage& a, int channelA, const FloatImage& b, int channelB) {
    Plane plane(a.width, a.height);
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        const double valueA = a.pixels[i * a.channelCount() + static_cast<std::size_t>(channelA)];
        const double valueB = b.pixels[i * b.channelCount() + static_cast<std::size_t>(channelB)];
        plane.values[i] = valueA * valueB;
    }
    return plane;
}

Plane channelPlane(const FloatImage& image, int channel) {
    Plane plane(image.width, image.height);
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        plane.values[i] =
            image.pixels[i * image.channelCount() + static_cast<std::size_t>(channel)];
    }
    return plane;
}

} // namespace

double structuralSimilarity(const FloatImage& a, const FloatImage& b) {
    CELADON_ASSERT(a.width == b.width && a.height == b.height && a.channels == b.channels);
    const std::vector<double> window = gaussianKernel(kSigma, kRadius);
    const auto mean = [&](const Plane& plane) { return filterSeparable(plane, window, window); };
    const bool hasInside = a.width > 2 * kRadius && a.height > 2 * kRadius;
    const int border = hasInside ? kRadius : 0;

    double sum = 0.0;
    std::size_t count = 0;
    for (int c = 0; c < static_cast<int>(a.channelCount()); ++c) {
        const Plane meanA = mean(channelPlane(a, c));
        const Plane meanB = mean(channelPlane(b, c));
        const Plane squareA = mean(product(a, c, a, c));
        const Plane squareB = mean(product(b, c, b, c));
        const Plane cross = mean(product(a, c, b, c));
        for (int y = border; y < a.height - border; ++y) {
            for (int x = border; x < a.width - border; ++x) {
                const std::size_t i =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                    static_cast<std::size_t>(x);
                const double muA = meanA.values[i];
                const double muB = meanB.values[i];
                const double varianceA = squareA.values[i] - muA * muA;
                const double varianceB = squareB.values[i] - muB * muB;
                const double covariance = cross.values[i] - muA * muB;
                // Sums of products are written so that equal pictures give equal bits.
                sum += (muA * muB + muA * muB + kC1) * (covariance + covariance + kC2) /
                       ((muA * muA + muB * muB + kC1) * (varianceA + varianceB + kC2));
                ++count;
            }
        }
    }
    return sum / static_cast<double>(count);
}

} // namespace celadon
