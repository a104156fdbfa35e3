#pragma once

#include "app/bench/bench_scene.h"
#include "renderer/frame_renderer.h"
#include "renderer/gl/context.h"

#include <optional>

namespace celadon::app {

/// One column of Table 1, and ours.
struct BenchMethod {
    std::string name;
    FrameSettings settings;
    bool isSlow = false; ///< one frame is measured, after one that warms up
};

/// none, multires, adaptive, paper; then hierarchical and draft.
[[nodiscard]] std::vector<BenchMethod> benchMethods();

struct BenchOptions {
    std::string suite = "quick";
    int repeats = 5;
    glm::ivec2 size{400, 300};     ///< frame in which times are measured
    glm::ivec2 truthSize{120, 90}; ///< and errors
    bool surfaceTruth = false;     ///< against the surface too
    bool slowMethods = true;       ///< none, multires and adaptive
};

/// Relative RMSE and mean ratio of the exitance.
struct BenchError {
    double relativeRmse = kNotMeasured;
    double meanRatio = kNotMeasured;
};

struct BenchTime {
    double medianMs = kNotMeasured, leastMs = kNotMeasured, greatestMs = kNotMeasured;
    int frames = 0;
    StageMilliseconds stages; ///< of the median frame
    std::uint64_t pairs = 0;
};

struct MethodResult {
    std::string method;
    BenchTime time;
    BenchError image;           ///< against image-reference
    BenchError surface;         ///< against surface-reference
    double flip = kNotMeasured; ///< of the final picture, against image-reference
};

struct SceneResult {
    BenchScene scene;
    std::string model;
    bool isStandIn = false;
    std::size_t triangles = 0;
    std::vector<MethodResult> methods;
};

/// All methods on one scene, one after the other, in one process.
[[nodiscard]] SceneResult runScene(const gl::Context& context, const BenchScene& scene,
                                   const BenchOptions& options);

} // namespace celadon::app
