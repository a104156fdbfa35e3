#include "app/bench/bench_measure.h"

#include "renderer/gpu_deformation.h"
#include "renderer/output/flip.h"
#include "renderer/output/image_compare.h"
#include "renderer/output/tone_map.h"
#include "renderer/reference/reference_solvers.h"
#include "renderer/splatting/splatting_solver.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <fstream>
#include <thread>

namespace celadon::app {

namespace {

/// White diffuse paper that faces the light leaves with 1 W/m^2/sr: well exposed.
constexpr double kIrradiance = 3.0;

std::string describeProcessor() {
    std::string name = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) {
            name = line.substr(line.find(':') + 2);
            break;
        }
    }
    return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

BenchTime summarize(std::vector<StageMilliseconds> times) {
    std::ranges::sort(times, {}, &StageMilliseconds::total);
    BenchTime time;
    time.stages = times[times.size() / 2];
    time.medianMs = time.stages.total;
    time.leastMs = times.front().total;
    time.greatestMs = times.back().total;
    time.frames = static_cast<int>(times.size());
    return time;
}

} // namespace

BenchView benchView(const World& world, glm::ivec2 size) {
    Light light;
    light.direction = glm::normalize(glm::dvec3(-0.4, -0.5, -0.77));
    light.color = glm::dvec3(kIrradiance);
    return {chooseCamera(world, {}, static_cast<double>(size.x) / size.y), {light}};
}

BenchView withTurnedLight(BenchView view, double degrees) {
    const double c = std::cos(glm::radians(degrees));
    const double s = std::sin(glm::radians(degrees));
    for (Light& light : view.lights) {
        const glm::dvec3 d = light.direction;
        light.direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    }
    return view;
}

FloatImage renderFrame(const gl::Context& context, const World& world, FrameSettings settings,
                       glm::ivec2 size, const BenchView& view) {
    settings.size = size;
    settings.layers = true;
    return FrameRenderer(context, world, settings).render(view.camera, view.lights).image;
}

FrameSettings referenceSettings(SolverKind solver, int blocks) {
    FrameSettings settings;
    settings.solver = solver;
    settings.referenceBlocks = blocks;
    return settings;
}

FloatImage referencePixels(const FloatImage& image, int blocks) {
    const FloatImage exitance = extractLayer(image, "exitance");
    FloatImage row;
    row.height = 1;
    row.channels = exitance.channels;
    for (int y = 0; y < exitance.height; ++y) {
        for (int x = 0; x < exitance.width; ++x) {
            if (isReferencePixel(x, exitance.height - 1 - y, blocks)) {
                for (int c = 0; c < 3; ++c) {
                    row.pixels.push_back(exitance.at(x, y, c));
                }
                ++row.width;
            }
        }
    }
    return row;
}

BenchError exitanceError(const FloatImage& image, const FloatImage& truth, int blocks) {
    const ValueErrors errors =
        compareValues(referencePixels(image, blocks), referencePixels(truth, blocks));
    return {errors.relativeRmse, errors.meanRatio};
}

double flipOf(const FloatImage& image, const FloatImage& truth) {
    return meanValue(flipMap(toDisplayLight(extractLayer(image, ""), ToneMap::Neutral),
                             toDisplayLight(extractLayer(truth, ""), ToneMap::Neutral)));
}

MeasuredFrame measureFrames(const gl::Context& context, const World& world, FrameSettings settings,
                            glm::ivec2 size, const BenchView& view, const TimeBudget& budget) {
    settings.size = size;
    settings.layers = true;
    FrameRenderer renderer(context, world, settings);
    auto* splatting = dynamic_cast<SplattingSolver*>(&renderer.solver());
    MeasuredFrame measured;
    if (splatting != nullptr) {
        splatting->collectStatistics(true);
    }
    RenderedFrame first = renderer.render(view.camera, view.lights);
    measured.image = std::move(first.image);
    if (splatting != nullptr) {
        FrameStats stats;
        splatting->report(stats);
        measured.pairs = stats.samples.pairs;
        splatting->collectStatistics(false);
    }
    const double firstSeconds = first.stats.milliseconds.total / 1000.0;
    if (firstSeconds > budget.slowSeconds) {
        measured.time = summarize({first.stats.milliseconds});
        return measured;
    }
    const int frames = std::clamp(
        static_cast<int>(budget.secondsAMethod / std::max(firstSeconds, 1e-3)), 1, budget.repeats);
    std::vector<StageMilliseconds> times;
    for (int i = 0; i < frames; ++i) {
        times.push_back(renderer.render(view.camera, view.lights).stats.milliseconds);
    }
    measured.time = summarize(std::move(times));
    return measured;
}

double measureDeformation(const gl::Context& context, const World& rest, const Pose& pose,
                          int repeats) {
    const GpuScene scene(rest, FrameSettings{});
    GpuDeformation deformation(scene.shaders, rest, scene.gpuWorld);
    gl::StageTimer timer(context);
    std::vector<double> times;
    deformation.apply(pose); // warms up
    for (int i = 0; i < std::max(repeats, 1); ++i) {
        {
            const auto scope = timer.measure("deformation");
            deformation.apply(pose);
        }
        times.push_back(timer.take().front().timeMs);
    }
    std::ranges::sort(times);
    return times[times.size() / 2];
}

BenchMachine describeMachine(const gl::Context& context) {
    return {gl::contextKindName(context.kind()), context.renderer(), context.version(),
            describeProcessor()};
}

} // namespace celadon::app
