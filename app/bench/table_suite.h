#pragma once

#include "app/bench/bench_measure.h"
#include "app/bench/bench_scene.h"

#include <functional>
#include <string>
#include <vector>

/// The suites `table1` and `quick`: the columns of Chen et al. 2012, Table 1, and ours, on each
/// scene, times and errors of the same frame in one run.
namespace celadon::app {

/// One column of Table 1, or ours.
struct BenchMethod {
    std::string name;
    FrameSettings settings;
    std::size_t paperColumn = 3; ///< of BenchScene::paperFps
};

/// none, multires, adaptive, paper; then hierarchical, draft and final.
[[nodiscard]] std::vector<BenchMethod> benchMethods();

struct TableOptions {
    std::string suite = "quick";
    glm::ivec2 size{400, 300};
    TimeBudget budget;
    std::vector<std::string> methods;       ///< names; empty: all
    std::vector<std::string> scenes;        ///< names; empty: all
    std::vector<SplatBackendKind> backends; ///< not Auto
    int truthBlocks = 1;                    ///< truth on one block of pixels in so many
    bool surfaceTruth = true;
    bool modelError = false;
};

struct MethodResult {
    std::string method;
    SplatBackendKind backend = SplatBackendKind::Cpu;
    BenchTime time;
    std::uint64_t pairs = 0;
    BenchError image;           ///< against image-reference
    BenchError surface;         ///< against surface-reference: the splatting error
    double flip = kNotMeasured; ///< of the final picture; only where truth has every pixel
};

/// What the profiles and their product miss, whatever splats them: surface-reference with the
/// profile of a homogeneous medium against light traced in that medium.
struct ModelError {
    BenchError error;            ///< the noise of both taken out
    double noise = kNotMeasured; ///< relative standard error of both together
    glm::dvec3 meanFreePathMm{0.0};
};

struct SceneResult {
    BenchScene scene;
    std::string model;
    bool isStandIn = false;
    std::size_t triangles = 0;
    double radiusPx = kNotMeasured; ///< mean R_P in the picture
    BenchError imageReference;      ///< image-reference against surface-reference
    std::vector<MethodResult> methods;
    ModelError modelError;
};

/// All methods on one scene, one after the other, in one process. @param progress after each method
[[nodiscard]] SceneResult runScene(const gl::Context& context, const BenchScene& scene,
                                   const TableOptions& options);

[[nodiscard]] const MethodResult* findMethod(const SceneResult& scene, const std::string& method,
                                             SplatBackendKind backend);

/// Times as fast as with no acceleration, by the same backend. NaN where one was not measured.
[[nodiscard]] double speedUp(const SceneResult& scene, const MethodResult& method);
/// The same in the paper.
[[nodiscard]] double paperSpeedUp(const BenchScene& scene, const std::string& method);

} // namespace celadon::app
