#include "renderer/output/separable_filter.h"

#include "subedit/assert.h"

#include <algorithm>
#include <cmath>

namespace celadon {

Plane filterSeparable(const Plane& plane, std::span<const double> horizontal,
                      std::span<const double> vertical) {
    CELADON_ASSERT(horizontal.size() % 2 == 1 && vertical.size() % 2 == 1);
    const int width = plane.width;
    const int height = plane.height;
    const auto row = [width](int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    };

    // A padded copy of each row keeps the inner loop free of conditions.
    const int radiusX = static_cast<int>(horizontal.size() / 2);
    std::vector<double> padded(static_cast<std::size_t>(width + 2 * radiusX));
    Plane rows(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = -radiusX; x < width + radiusX; ++x) {
            padded[static_cast<std::size_t>(x + radiusX)] =
                plane.values[row(y) + static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
        }
        double* out = rows.values.data() + row(y);
        for (std::size_t k = 0; k < horizontal.size(); ++k) {
            const double weight = horizontal[k];
            const double* in = padded.data() + k;
            for (int x = 0; x < width; ++x) {
                out[x] += weight * in[x];
            }
        }
    }

    const int radiusY = static_cast<int>(vertical.size() / 2);
    Plane result(width, height);
    for (int y = 0; y < height; ++y) {
        double* out = result.values.data() + row(y);
        for (int k = -radiusY; k <= radiusY; ++k) {
            const double weight = vertical[static_cast<std::size_t>(k + radiusY)];
            const double* in = rows.values.data() + row(std::clamp(y + k, 0, height - 1));
            for (int x = 0; x < width; ++x) {
                out[x] += weight * in[x];
            }
        }
    }
    return result;
}

std::vector<double> gaussianKernel(double sigmaPixels, int radius) {
    std::vector<double> weights;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        weights.push_back(std::exp(-0.5 * x * x / (sigmaPixels * sigmaPixels)));
        sum += weights.back();
    }
    std::vector<double> kernel;
    for (const double weight : weights) {
        kernel.push_back(weight / sum);
    }
    return kernel;
}

} // namespace celadon
