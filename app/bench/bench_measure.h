#pragma once

#include "renderer/frame_renderer.h"
#include "renderer/gl/context.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/motion.h"

#include <glm/vec2.hpp>

#include <string>
#include <vector>

/// What all suites measure with: a scene's view and light, frames of it, their times and errors.
namespace celadon::app {

struct BenchView {
    Camera camera;
    std::vector<Light> lights;
};

/// The view that fits, and one directional light from the front, above and to the left.
[[nodiscard]] BenchView benchView(const World& world, glm::ivec2 size);

/// The light turned about the vertical.
[[nodiscard]] BenchView withTurnedLight(BenchView view, double degrees);

/// One frame with its layers.
[[nodiscard]] FloatImage renderFrame(const gl::Context& context, const World& world,
                                     FrameSettings settings, glm::ivec2 size,
                                     const BenchView& view);

/// Settings of image- or surface-reference. @param blocks see FrameSettings::referenceBlocks
[[nodiscard]] FrameSettings referenceSettings(SolverKind solver, int blocks = 1);

/// Of the exitance.
struct BenchError {
    double relativeRmse = kNotMeasured;
    double meanRatio = kNotMeasured;
};
/// @param blocks that truth was computed on
[[nodiscard]] BenchError exitanceError(const FloatImage& image, const FloatImage& truth,
                                       int blocks = 1);

/// The exitance of the pixels that a reference on so many blocks computes, in a row.
[[nodiscard]] FloatImage referencePixels(const FloatImage& image, int blocks);

/// Mean FLIP of the final pictures, shown as --tonemap neutral before black.
[[nodiscard]] double flipOf(const FloatImage& image, const FloatImage& truth);

struct BenchTime {
    double medianMs = kNotMeasured, leastMs = kNotMeasured, greatestMs = kNotMeasured;
    int frames = 0;
    StageMilliseconds stages; ///< of the median frame
};

struct TimeBudget {
    int repeats = 5;            ///< frames at most, of which the median counts
    double secondsAMethod = 10; ///< no more frames than fit, but at least one
    /// A frame that takes longer than this warms up nothing: compiling is a small part of it.
    double slowSeconds = 30;
};

/// A picture and what it cost: the first frame warms up and counts pairs, unless it is slow; then
/// it is the one that is timed.
struct MeasuredFrame {
    FloatImage image; ///< with layers
    BenchTime time;
    std::uint64_t pairs = 0;
};
[[nodiscard]] MeasuredFrame measureFrames(const gl::Context& context, const World& world,
                                          FrameSettings settings, glm::ivec2 size,
                                          const BenchView& view, const TimeBudget& budget);

/// Median time of moving a world's vertices on the GPU, which a frame of it begins with.
[[nodiscard]] double measureDeformation(const gl::Context& context, const World& rest,
                                        const Pose& pose, int repeats);

/// The driver and the machine, for reports.
struct BenchMachine {
    std::string contextKind, renderer, version, processor;
};
[[nodiscard]] BenchMachine describeMachine(const gl::Context& context);

} // namespace celadon::app
