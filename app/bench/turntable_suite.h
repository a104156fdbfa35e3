#pragma once

#include "app/bench/bench_document.h"
#include "app/bench/bench_scene.h"

#include <vector>

/// The suite `turntable`: a light that goes around an object, and how much the picture flickers
/// beyond its truth when it moves a little (renderer/output/flicker.h).
namespace celadon::app {

struct TurntableOptions {
    glm::ivec2 size{320, 240};
    int frames = 24;          ///< pictures around
    int places = 2;           ///< around, at which flicker is measured
    double stepDegrees = 0.3; ///< the light's, or the camera's, from one frame to the next
    int truthBlocks = 4;      ///< truth on one block of pixels in so many
    bool surfaceTruth = true;
    bool pictures = true;
};

/// @param scenes  of which the first is drawn as pictures
[[nodiscard]] BenchDocument runTurntable(const gl::Context& context,
                                         const std::vector<BenchScene>& scenes,
                                         const TurntableOptions& options);

} // namespace celadon::app
