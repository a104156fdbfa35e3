#include "renderer/reference/error_metrics.h"

#include "subedit/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace celadon {

ErrorMetrics compareExitance(std::span<const glm::vec3> values,
                             std::span<const glm::vec3> references) {
    CELADON_ASSERT(values.size() == references.size() && !values.empty());
    double squaredDifference = 0.0;
    double squaredReference = 0.0;
    double sum = 0.0;
    double referenceSum = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(values[i][c]);
            const auto reference = static_cast<double>(references[i][c]);
            const double difference = value - reference;
            squaredDifference += difference * difference;
            squaredReference += reference * reference;
            sum += value;
            referenceSum += reference;
            largest = std::max(largest, std::abs(difference));
        }
    }
    if (!std::isfinite(squaredDifference) || !std::isfinite(squaredReference)) {
        return {0.0, 0.0, 0.0, false};
    }
    if (squaredDifference == 0.0) {
        return {};
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (squaredReference == 0.0) {
        return {kInfinity, kInfinity, kInfinity, true};
    }
    const double scale = std::sqrt(squaredReference / (3.0 * static_cast<double>(values.size())));
    return {std::sqrt(squaredDifference / squaredReference), sum / referenceSum, largest / scale,
            true};
}

} // namespace celadon
