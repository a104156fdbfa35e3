#pragma once

#include "app/bench/bench_document.h"

/// The suite `scaling`: how the cost of a frame grows with the range of the material, the pixels of
/// the picture, the texels of the light view and the triangles, one doubled at a time.
namespace celadon::app {

struct ScalingOptions {
    glm::ivec2 size{400, 300}; ///< of the frame that is varied
    TimeBudget budget{.repeats = 3, .secondsAMethod = 5, .slowSeconds = 60};
    SplatBackendKind backend = SplatBackendKind::Auto; ///< not Auto
};

[[nodiscard]] BenchDocument runScaling(const gl::Context& context, const ScalingOptions& options);

/// Least-squares slope of ln y over ln x: cost grows as x to this power. NaN below two points that
/// are positive.
[[nodiscard]] double growthExponent(const std::vector<glm::dvec2>& points);

} // namespace celadon::app
