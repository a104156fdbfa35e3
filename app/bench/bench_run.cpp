#include "app/bench/bench_run.h"

#include "app/log.h"
#include "renderer/frame_quality.h"
#include "renderer/output/flip.h"
#include "renderer/output/image_compare.h"
#include "renderer/output/tone_map.h"
#include "renderer/scene/light.h"

#include <algorithm>
#include <array>

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

/// Three quarters from the front, above and to the left.
Light benchLight() {
    Light light;
    light.direction = glm::normalize(glm::dvec3(-0.4, -0.5, -0.77));
    return light;
}

struct View {
    Camera camera;
    std::array<Light, 1> lights;
};

View viewOf(const World& world, glm::ivec2 size) {
    return {chooseCamera(world, {}, static_cast<double>(size.x) / size.y), {benchLight()}};
}

FloatImage renderOnce(const gl::Context& context, const World& world, FrameSettings settings,
                      glm::ivec2 size) {
    settings.size = size;
    settings.layers = true;
    const View view = viewOf(world, size);
    return FrameRenderer(context, world, settings).render(view.camera, view.lights).image;
}

BenchError errorOf(const FloatImage& image, const FloatImage& truth) {
    const ValueErrors errors =
        compareValues(extractLayer(image, "exitance"), extractLayer(truth, "exitance"));
    return {errors.relativeRmse, errors.meanRatio};
}

double flipOf(const FloatImage& image, const FloatImage& truth) {
    DisplaySettings display;
    display.background = glm::vec3(0.0f);
    return meanValue(flipMap(toDisplay(extractLayer(image, ""), display),
                             toDisplay(extractLayer(truth, ""), display)));
}

BenchTime timeOf(const gl::Context& context, const World& world, FrameSettings settings,
                 glm::ivec2 size, int frames) {
    settings.size = size;
    settings.statistics = true; // each frame is drawn twice: counted, which warms up, then timed
    const View view = viewOf(world, size);
    FrameRenderer renderer(context, world, settings);
    BenchTime time;
    std::vector<StageMilliseconds> times;
    for (int i = 0; i < frames; ++i) {
        const FrameStats stats = renderer.render(view.camera, view.lights).stats;
        times.push_back(stats.milliseconds);
        time.pairs = stats.samples.pairs;
    }
    std::ranges::sort(times, {}, &StageMilliseconds::total);
    time.stages = times[times.size() / 2];
    time.medianMs = time.stages.total;
    time.leastMs = times.front().total;
    time.greatestMs = times.back().total;
    time.frames = frames;
    return time;
}

} // namespace

std::vector<BenchMethod> benchMethods() {
    return {{"none", paperSettings(false, false), true},
            {"multires", paperSettings(false, true), true},
            {"adaptive", paperSettings(true, false), true},
            {"paper", paperSettings(true, true), true},
            {"hierarchical", frameSettings(Quality::Default), false},
            {"draft", frameSettings(Quality::Draft), false}};
}

SceneResult runScene(const gl::Context& context, const BenchScene& scene,
                     const BenchOptions& options) {
    const BenchWorld loaded = loadBenchWorld(scene);
    SceneResult result{scene, loaded.model, loaded.isStandIn, loaded.triangles, {}};
    FrameSettings truthSettings;
    truthSettings.solver = SolverKind::ImageReference;
    log::info("{}: image-reference", scene.name);
    const FloatImage truth = renderOnce(context, loaded.world, truthSettings, options.truthSize);
    FloatImage surface;
    if (options.surfaceTruth) {
        log::info("{}: surface-reference", scene.name);
        truthSettings.solver = SolverKind::SurfaceReference;
        surface = renderOnce(context, loaded.world, truthSettings, options.truthSize);
    }
    for (const BenchMethod& method : benchMethods()) {
        if (method.isSlow && !options.slowMethods) {
            continue;
        }
        log::info("{}: {}", scene.name, method.name);
        MethodResult measured;
        measured.method = method.name;
        const FloatImage image =
            renderOnce(context, loaded.world, method.settings, options.truthSize);
        measured.image = errorOf(image, truth);
        measured.flip = flipOf(image, truth);
        if (options.surfaceTruth) {
            measured.surface = errorOf(image, surface);
        }
        measured.time = timeOf(context, loaded.world, method.settings, options.size,
                               method.isSlow ? 1 : options.repeats);
        result.methods.push_back(measured);
    }
    return result;
}

} // namespace celadon::app
