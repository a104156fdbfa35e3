#include "app/bench/table_suite.h"

#include "app/log.h"
#include "app/render_scene.h"
#include "renderer/frame_quality.h"
#include "renderer/output/image_compare.h"
#include "subedit/effective_radius.h"
#include "subedit/models/half_space.h"
#include "subedit/radius_map.h"

#include <algorithm>
#include <cmath>

namespace celadon::app {

namespace {

FrameSettings paperSettings(bool adaptive, bool multiresolution) {
    FrameSettings settings;
    settings.splatting.scheme = Scheme::Paper;
    settings.splatting.irradianceLevels = 3;
    settings.splatting.splattingLevels = 3;
    settings.splatting.adaptive = adaptive;
    settings.splatting.multiresolution = multiresolution;
    return settings;
}

bool isWanted(const std::vector<std::string>& wanted, const std::string& name) {
    return wanted.empty() || std::ranges::find(wanted, name) != wanted.end();
}

/// The world of a scene, deformed where the paper's was, and what deforming it costs.
struct Stage {
    World world;
    double deformationMs = 0.0;
};

Stage makeStage(const gl::Context& context, const BenchScene& scene, World rest) {
    if (scene.deformation.empty()) {
        return {std::move(rest), 0.0};
    }
    Motion motion(rest);
    motion.setDeformers({parseDeformer(scene.deformation)});
    const Pose pose = motion.at(0.0);
    constexpr int kRepeats = 5;
    return {posedWorld(rest, pose), measureDeformation(context, rest, pose, kRepeats)};
}

/// Homogeneous, of the scene's mean range and its albedo.
subedit::Medium mediumOf(const BenchScene& scene, double boundingRadiusMm) {
    glm::dvec3 albedo = kBenchAlbedo;
    for (int c = 0; c < 3; ++c) {
        albedo[c] = subedit::reducedAlbedoFromTotal(albedo[c], kBenchEta);
    }
    const subedit::Medium unit = subedit::mediumFromAlbedo(albedo, glm::dvec3(1.0), kBenchEta);
    const glm::dvec3 R_P = subedit::effectiveRadiusMm(
        subedit::profileAt(*bakeMedium(unit), 0, 0)); // of a mean free path of 1 mm
    const double wanted = 0.5 * (scene.range.x + scene.range.y) * boundingRadiusMm;
    const double lengthMm = wanted / std::max({R_P.x, R_P.y, R_P.z});
    return subedit::mediumFromAlbedo(albedo, glm::dvec3(lengthMm), kBenchEta);
}

ModelError measureModelError(const gl::Context& context, const BenchScene& scene, World world,
                             glm::ivec2 size) {
    constexpr std::uint64_t kPaths = 1'000'000;
    const subedit::Medium medium = mediumOf(scene, world.scatteringSphere.radius);
    world.materials.assign(world.materials.size(), bakeMedium(medium));
    const BenchView view = benchView(world, size);
    const auto solve = [&](SolverKind solver) {
        FrameSettings settings = referenceSettings(solver);
        settings.size = size;
        settings.layers = true;
        settings.pathTraced.medium = medium;
        settings.pathTraced.paths = kPaths;
        return FrameRenderer(context, world, settings).render(view.camera, view.lights);
    };
    const RenderedFrame walked = solve(SolverKind::PathTraced);
    const RenderedFrame profile = solve(SolverKind::SurfaceReference);
    ModelError result;
    result.meanFreePathMm = 1.0 / medium.reducedExtinction();
    result.error = exitanceError(profile.image, walked.image);
    result.noise =
        std::hypot(walked.stats.reference.relativeError, profile.stats.reference.relativeError);
    result.error.relativeRmse = std::sqrt(std::max(
        0.0, result.error.relativeRmse * result.error.relativeRmse - result.noise * result.noise));
    return result;
}

double meanRadiusPx(const FloatImage& image, const Camera& camera, const World& world) {
    const FloatImage radius = extractLayer(image, "radius");
    double sum = 0.0;
    int seen = 0;
    for (const float value : radius.pixels) {
        if (value > 0.0f) {
            sum += static_cast<double>(value);
            ++seen;
        }
    }
    const CameraView view = makeCameraView(camera, image.width, image.height);
    const double depth = glm::dot(world.scatteringSphere.center - view.eye, view.frame.forward);
    return seen > 0 ? sum / seen / view.pixelWidth.atDepthMm(depth) : kNotMeasured;
}

} // namespace

std::vector<BenchMethod> benchMethods() {
    return {{"none", paperSettings(false, false), 0},
            {"multires", paperSettings(false, true), 1},
            {"adaptive", paperSettings(true, false), 2},
            {"paper", paperSettings(true, true), 3},
            {"hierarchical", frameSettings(Quality::Default), 3},
            {"draft", frameSettings(Quality::Draft), 3},
            {"final", frameSettings(Quality::Final), 3}};
}

SceneResult runScene(const gl::Context& context, const BenchScene& scene,
                     const TableOptions& options) {
    BenchWorld loaded = loadBenchWorld(scene);
    SceneResult result{scene, loaded.model, loaded.isStandIn, loaded.triangles, {}, {}, {}, {}};
    const Stage stage = makeStage(context, scene, std::move(loaded.world));
    const BenchView view = benchView(stage.world, options.size);
    const auto reference = [&](SolverKind solver) {
        log::info("{}: {}", scene.name,
                  solver == SolverKind::ImageReference ? "image-reference" : "surface-reference");
        return renderFrame(context, stage.world, referenceSettings(solver, options.truthBlocks),
                           options.size, view);
    };
    const FloatImage truth = reference(SolverKind::ImageReference);
    FloatImage surface;
    if (options.surfaceTruth) {
        surface = reference(SolverKind::SurfaceReference);
        result.imageReference = exitanceError(truth, surface, options.truthBlocks);
    }
    result.radiusPx = meanRadiusPx(truth, view.camera, stage.world);
    for (const SplatBackendKind backend : options.backends) {
        for (BenchMethod method : benchMethods()) {
            if (!isWanted(options.methods, method.name)) {
                continue;
            }
            method.settings.splatting.backend = backend;
            MeasuredFrame frame = measureFrames(context, stage.world, method.settings, options.size,
                                                view, options.budget);
            MethodResult measured;
            measured.method = method.name;
            measured.backend = backend;
            measured.time = frame.time;
            measured.time.stages.deformation = stage.deformationMs;
            for (double* total : {&measured.time.stages.total, &measured.time.medianMs,
                                  &measured.time.leastMs, &measured.time.greatestMs}) {
                *total += stage.deformationMs;
            }
            measured.pairs = frame.pairs;
            measured.image = exitanceError(frame.image, truth, options.truthBlocks);
            if (options.surfaceTruth) {
                measured.surface = exitanceError(frame.image, surface, options.truthBlocks);
            }
            if (options.truthBlocks == 1) {
                measured.flip = flipOf(frame.image, options.surfaceTruth ? surface : truth);
            }
            log::info("{}: {} by {}: {:.0f} ms, {:.2f} %", scene.name, method.name,
                      backendName(backend), measured.time.medianMs,
                      100.0 *
                          (options.surfaceTruth ? measured.surface : measured.image).relativeRmse);
            result.methods.push_back(measured);
        }
    }
    if (options.modelError) {
        log::info("{}: path-traced", scene.name);
        constexpr glm::ivec2 kSize(96, 72); // walks are dear
        result.modelError = measureModelError(context, scene, stage.world, kSize);
    }
    return result;
}

const MethodResult* findMethod(const SceneResult& scene, const std::string& method,
                               SplatBackendKind backend) {
    const auto found = std::ranges::find_if(scene.methods, [&](const MethodResult& result) {
        return result.method == method && result.backend == backend;
    });
    return found != scene.methods.end() ? &*found : nullptr;
}

double speedUp(const SceneResult& scene, const MethodResult& method) {
    const MethodResult* none = findMethod(scene, "none", method.backend);
    return none != nullptr ? none->time.medianMs / method.time.medianMs : kNotMeasured;
}

double paperSpeedUp(const BenchScene& scene, const std::string& method) {
    for (const BenchMethod& known : benchMethods()) {
        if (known.name == method && scene.paperFps[0] > 0.0) {
            return scene.paperFps[known.paperColumn] / scene.paperFps[0];
        }
    }
    return kNotMeasured;
}

} // namespace celadon::app
