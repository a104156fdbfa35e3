#pragma once

#include <glm/vec3.hpp>

#include <span>

/// How far one set of exitances is from another: what references and solvers are compared by.
namespace celadon {

struct ErrorMetrics {
    /// Root of the sum of squared differences over the sum of squared references, all channels.
    double relativeRmse = 0.0;
    double meanRatio = 1.0;    ///< sum of the values over that of the references
    double largestError = 0.0; ///< largest difference over the references' root mean square
    bool finite = true;        ///< all values and references are; the others are 0 when not
};

/// @param values     as many as references, not empty
/// @return           errors of 0 and ratio 1 if both are all zero; infinite if references alone are
[[nodiscard]] ErrorMetrics compareExitance(std::span<const glm::vec3> values,
                                           std::span<const glm::vec3> references);

} // namespace celadon
