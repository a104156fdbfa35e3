#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Convolution of single-channel pictures by a product of two one-dimensional kernels: the common
/// part of the perceptual metrics.
namespace celadon {

struct Plane {
    int width = 0;
    int height = 0;
    std::vector<double> values; ///< [height][width]

    Plane(int w, int h)
        : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
};

/// Beyond the border the nearest pixel is repeated. Kernels have odd lengths, centered, and are
/// not flipped (correlation).
[[nodiscard]] Plane filterSeparable(const Plane& plane, std::span<const double> horizontal,
                                    std::span<const double> vertical);

/// exp(-x^2 / 2 sigma^2) at whole x in [-radius, radius], sum 1.
[[nodiscard]] std::vector<double> gaussianKernel(double sigmaPixels, int radius);

} // namespace celadon
