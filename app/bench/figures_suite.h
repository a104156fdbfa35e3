#pragma once

#include "app/bench/bench_document.h"
#include "app/bench/bench_scene.h"

#include <vector>

/// The suite `figures`: what Figs. 4, 5 and 6 of Chen et al. 2012 show, and a slab of two
/// materials. Each picture is a row of frames; below each, the heat map of its error in exitance
/// against the first, white at a fifth of truth's root mean square.
namespace celadon::app {

struct FiguresOptions {
    glm::ivec2 size{320, 240};
    SplatBackendKind backend = SplatBackendKind::Auto; ///< not Auto
    TimeBudget budget{.repeats = 3, .secondsAMethod = 3, .slowSeconds = 60};
};

/// @param scenes  each is drawn ours beside truth; the second shows the terms of the selection,
///                the first the comparison with splats of one rate (one scene serves for both)
[[nodiscard]] BenchDocument runFigures(const gl::Context& context,
                                       const std::vector<BenchScene>& scenes,
                                       const FiguresOptions& options);

} // namespace celadon::app
