#include "app/command_render.h"

#include "app/log.h"
#include "app/overwriting.h"
#include "app/progress.h"
#include "app/render_motion.h"
#include "app/render_scene.h"
#include "renderer/environment_background.h"
#include "renderer/frame_renderer.h"
#include "renderer/gpu_deformation.h"
#include "renderer/output/image_io.h"
#include "renderer/output/tone_map.h"
#include "renderer/scene/camera.h"
#include "subedit/atomic_file.h"
#include "subedit/errors.h"
#include "subedit/map/range_table_file.h"
#include "subedit/map/shipped_materials.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace celadon::app {
namespace {

/// The files of a sequence are poses already: their animations wait to be asked for.
MotionRequest motionOf(const RenderOptions& options) {
    return {options.animation, options.timeSeconds, options.deformations,
            options.frames && !options.sequence};
}

/// What is read and written in a frame: nothing may be written over something else, and models of
/// a sequence have to be there.
void checkFilesOfFrame(const RenderOptions& options, int frame) {
    std::vector<NamedFile> outputs{{"--output", outputOfFrame(options, frame)}};
    if (options.stats) {
        outputs.push_back({"--stats", *options.stats});
    }
    std::vector<NamedFile> inputs{{"MODEL", modelOfFrame(options, frame)}};
    if (options.material) {
        inputs.push_back({"--material", subedit::findMaterial(materialOfFrame(options, frame))});
    }
    if (options.materialTo) {
        inputs.push_back({"--material-to", subedit::findMaterial(*options.materialTo)});
    }
    if (options.environment) {
        inputs.push_back({"--environment", *options.environment});
    }
    if (options.table) {
        inputs.push_back({"--table", *options.table});
    }
    for (const std::string& deformation : options.deformations) {
        inputs.push_back({"--deform", deformation});
    }
    refuseOverwriting(outputs, inputs);
    std::error_code reason;
    if (options.sequence && !std::filesystem::exists(inputs.front().file, reason)) {
        throw InputError(fmt::format("'{}'", inputs.front().file.string()),
                         fmt::format("{}, for frame {} of --sequence",
                                     reason ? reason.message() : "no such file", frame));
    }
}

/// What cannot be read or written is refused before the work, not after.
void checkFiles(const RenderOptions& options) {
    const FrameRange frames = options.frames.value_or(FrameRange{});
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        checkFilesOfFrame(options, frame);
    }
    checkWritable(outputOfFrame(options, frames.first));
    if (options.stats) {
        checkWritable(*options.stats);
    }
}

void warnOfIdleOptions(const RenderOptions& options) {
    if (const std::vector<std::string> idle = idleOptions(options); !idle.empty()) {
        log::warning("{}: of no effect without --scheme paper", fmt::join(idle, ", "));
    }
    std::vector<std::string> ofPaths;
    if (options.paths) {
        ofPaths.emplace_back("--paths");
    }
    if (options.noise > 0.0) {
        ofPaths.emplace_back("--noise");
    }
    if (options.solver != Solver::PathTraced && !ofPaths.empty()) {
        log::warning("{}: of no effect without --solver path-traced", fmt::join(ofPaths, ", "));
    }
}

/// Paths traced of all, or how far the error has come towards the one that is asked for: it falls
/// as the root of their number.
std::function<void(std::uint64_t, double)> pathProgress(const PathTracedSettings& settings) {
    constexpr std::size_t kSteps = 100;
    return [bar = std::make_shared<Progress>("path tracing", kSteps), all = settings.paths,
            noise = settings.noise, most = 0.0](std::uint64_t paths, double relativeError) mutable {
        const double byCount = static_cast<double>(paths) / static_cast<double>(all);
        const double byNoise = relativeError > 0.0 ? noise / relativeError : 0.0;
        most = std::min(std::max({most, byCount, byNoise * byNoise}), 1.0); // noise may grow again
        bar->update(static_cast<std::size_t>(most * static_cast<double>(kSteps)));
    };
}

FrameSettings frameSettings(const RenderOptions& options) {
    FrameSettings settings = celadon::frameSettings(options.quality);
    settings.size = options.size;
    switch (options.solver) {
    case Solver::ImageReference:
        settings.solver = SolverKind::ImageReference;
        break;
    case Solver::SurfaceReference:
        settings.solver = SolverKind::SurfaceReference;
        break;
    case Solver::PathTraced:
        settings.solver = SolverKind::PathTraced;
        settings.pathTraced.medium = mediumOf(options).value();
        settings.pathTraced.paths = static_cast<std::uint64_t>(pathCount(options));
        settings.pathTraced.noise = options.noise;
        settings.pathTraced.progress = pathProgress(settings.pathTraced);
        break;
    case Solver::Splatting:
        settings.solver = SolverKind::Splatting;
        break;
    }
    SplattingSettings& splatting = settings.splatting;
    splatting.backend = options.backend;
    if (options.scheme == Scheme::Paper) {
        splatting.scheme = Scheme::Paper;
        splatting.energy = SplattingSettings().energy;
    }
    if (options.irradianceSize) {
        splatting.fixIrradianceSize(*options.irradianceSize);
    }
    if (options.levels) {
        splatting.irradianceLevels = options.levels->irradiance;
        splatting.splattingLevels = options.levels->splatting;
    }
    splatting.alpha = options.alpha.value_or(splatting.alpha);
    splatting.epsilon = options.epsilon.value_or(splatting.epsilon);
    if (options.table) {
        const auto table = subedit::readRangeTable(*options.table);
        splatting.rangeTable.assign(table.values().begin(), table.values().end());
    }
    splatting.discontinuity = options.discontinuity.value_or(splatting.discontinuity);
    splatting.energy = options.energy.value_or(splatting.energy);
    splatting.orientation = options.orientation;
    splatting.adaptive = options.adaptive;
    splatting.multiresolution = options.multiresolution;
    settings.exitFresnel = options.exitFresnel;
    settings.pointSamples = options.pointSamples;
    settings.specular = options.specular;
    settings.coverageSamples = options.samples;
    settings.layers = options.aov;
    settings.statistics = options.stats.has_value();
    return settings;
}

RenderStats statsHead(const RenderOptions& options, const FrameSettings& settings,
                      const gl::Context& context) {
    RenderStats stats;
    stats.contextKind = gl::contextKindName(context.kind());
    stats.contextRenderer = context.renderer();
    stats.contextVersion = context.version();
    stats.solver = solverName(options.solver);
    stats.scheme = schemeName(options.scheme);
    stats.backend = "cpu";
    stats.width = settings.size.x;
    stats.height = settings.size.y;
    stats.irradianceLevels = settings.splatting.adaptive ? settings.splatting.irradianceLevels : 1;
    stats.splattingLevels =
        settings.splatting.multiresolution ? settings.splatting.splattingLevels : 1;
    return stats;
}

void writePicture(const RenderOptions& options, const std::filesystem::path& file,
                  FloatImage image) {
    if (imageFormat(file) == ImageFormat::Exr) {
        if (options.background) {
            image = compositeOver(std::move(image), *options.background);
        }
        writeExr(file, image);
        return;
    }
    DisplaySettings display;
    display.exposureEv = static_cast<float>(options.exposureEv);
    display.toneMap = options.toneMap;
    display.background = options.background;
    if (!display.background && !holdsAlpha(imageFormat(file))) {
        display.background = glm::vec3(0.0f);
    }
    writeDisplayImage(file, toDisplay(image, display));
}

void warnOfInfinities(const FloatImage& image) {
    if (!std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); })) {
        log::warning("values of the picture are beyond all numbers: lights or environment are too "
                     "bright");
    }
}

/// A black picture is never silent.
void explainDarkness(const World& world, const Camera& camera, const RenderedFrame& frame,
                     const RenderOptions& options) {
    const CameraView view = makeCameraView(camera, options.size.x, options.size.y);
    if (isOutsideView(view, world.sceneSphere)) {
        log::warning(
            "the object is outside the view: move --view-from or --view-at, or leave both out");
        return;
    }
    if (!frame.seesScattering) {
        log::warning(
            "no pixel's center sees a scattering surface: it is hidden, or too small in the view");
        return;
    }
    double sum = 0.0;
    const std::size_t channels = frame.image.channelCount();
    for (std::size_t i = 0; i < frame.image.pixels.size(); i += channels) {
        for (std::size_t c = 0; c < 3; ++c) {
            sum += static_cast<double>(frame.image.pixels[i + c]);
        }
    }
    if (sum <= 0.0) {
        log::warning(
            "no light reaches the visible surface: check the direction, position and color "
            "of the lights");
    }
}

void warnAboutRadius(const World& world, const FrameStats& stats) {
    const EffectiveRadiusRange& radius = stats.effectiveRadius;
    log::info(
        "effective scattering radius {:.3g} to {:.3g} mm ({:.3g} pixels on average) on an object "
        "of {:.4g} mm",
        radius.minMm, radius.maxMm, radius.meanPixels, 2.0 * world.scatteringSphere.radius);
    if (radius.meanMm > 2.0 * world.scatteringSphere.radius) {
        log::warning(
            "the material scatters over {:.3g} mm, further than the object's {:.3g} mm: its "
            "size may be meant otherwise (--scale, --diameter)",
            radius.meanMm, 2.0 * world.scatteringSphere.radius);
    } else if (radius.meanPixels < 0.5) {
        log::warning(
            "the material scatters over {:.3g} mm, {:.2g} of a pixel: the picture will look "
            "opaque (--scale, --diameter)",
            radius.meanMm, radius.meanPixels);
    }
}

/// What a reference knows of its own error.
void tellNoise(const ReferenceError& noise, const RenderOptions& options) {
    constexpr double kMuchLost = 1e-3;
    if (std::isfinite(noise.relativeError)) {
        log::info("relative error {:.3g} (standard)", noise.relativeError);
        if (options.solver == Solver::PathTraced && options.noise > 0.0 &&
            noise.relativeError > options.noise) {
            log::warning("relative error {:.3g}: all paths are traced before --noise {:g}",
                         noise.relativeError, options.noise);
        }
    }
    if (noise.lostFlux > kMuchLost) {
        log::warning(
            "{:.2g} of the light got lost through holes of the mesh: path-traced needs a closed "
            "surface whose fronts look outwards",
            noise.lostFlux);
    }
}

/// What the frames of one world share: its motion, and the renderer that its vertices move in. The
/// frame's camera and lights are found with the rest pose's bounds, so that a default view stands
/// still while the object moves.
class FrameMaker {
public:
    FrameMaker(const RenderOptions& options, const FrameSettings& settings,
               const gl::Context& context, const Environment& environment, World world)
        : mOptions(options),
          mSettings(settings),
          mContext(context),
          mEnvironment(environment),
          mWorld(std::move(world)),
          mRestBounds{mWorld.scatteringSphere, mWorld.sceneSphere},
          mMotion(makeMotion(mWorld, motionOf(options))),
          mTimer(context) {
        for (const std::string& warning : mMotion.warnings()) {
            log::warning("{}", warning);
        }
    }

    [[nodiscard]] RenderedFrame make(int number) {
        const double seconds = mOptions.timeSeconds.value_or(number / mOptions.framesPerSecond);
        const Pose pose = inFrame(number, seconds, [&] { return mMotion.at(seconds); });
        mWorld.scatteringSphere = mRestBounds.scattering;
        mWorld.sceneSphere = mRestBounds.scene;
        if (mMotion.moves()) {
            mWorld.cameras = pose.cameras;
            mWorld.lights = pose.lights;
        }
        const Camera camera = cameraOf(mOptions, mWorld);
        const std::vector<Light> lights = lightsOf(mOptions, mWorld, camera);
        const double deformationMs = inFrame(number, seconds, [&] { return move(pose); });
        mRenderer->setEnvironment(mEnvironment);
        RenderedFrame frame = mRenderer->render(camera, lights);
        inFrame(number, seconds, [&] { learnBounds(pose); });
        frame.stats.frame = number;
        frame.stats.milliseconds.deformation = deformationMs;
        frame.stats.milliseconds.total += deformationMs;
        const World& shown = mPosed ? *mPosed : mWorld;
        explainDarkness(shown, camera, frame, mOptions);
        if (frame.seesScattering) {
            warnAboutRadius(shown, frame.stats);
        }
        tellNoise(frame.stats.reference, mOptions);
        if (mOptions.environmentBehind) {
            frame.image = compositeOverEnvironment(std::move(frame.image), mEnvironment, camera);
        }
        warnOfInfinities(frame.image);
        return frame;
    }

    [[nodiscard]] int irradianceSize() const { return mRenderer->irradianceSize(); }
    /// Of every mesh, from the next frame on.
    void setMaterial(MaterialPointer material) {
        mDeformation.reset();
        mRenderer.reset();
        mScene.reset();
        mWorld.materials = {std::move(material)};
    }
    [[nodiscard]] double millimetersPerUnit() const { return mWorld.millimetersPerUnit; }
    [[nodiscard]] SplatBackendKind backend() const { return mRenderer->backend(); }

private:
    const RenderOptions& mOptions;
    const FrameSettings& mSettings;
    const gl::Context& mContext;
    const Environment& mEnvironment;
    World mWorld; ///< vertices at rest; cameras, lights and bounds of the frame
    GpuDeformation::Bounds mRestBounds;
    Motion mMotion;
    gl::StageTimer mTimer;
    std::optional<World> mPosed; ///< for solvers that trace rays
    std::shared_ptr<const GpuScene> mScene;
    std::unique_ptr<FrameRenderer> mRenderer;
    std::unique_ptr<GpuDeformation> mDeformation;

    /// What cannot be posed or moved is said with its frame.
    template<typename Work>
    static std::invoke_result_t<const Work&> inFrame(int number, double seconds, const Work& work) {
        try {
            return work();
        } catch (const InputError& error) {
            throw InputError(fmt::format("frame {} at {:g} s", number, seconds), error.what());
        }
    }

    /// @return the time of it, ms
    double move(const Pose& pose) {
        if (mMotion.moves() && tracesRays(mSettings.solver)) {
            mRenderer.reset();
            mPosed = posedWorld(mWorld, pose);
            mRenderer = std::make_unique<FrameRenderer>(mContext, *mPosed, mSettings);
            return 0.0;
        }
        if (!mRenderer) {
            mScene = std::make_shared<const GpuScene>(mWorld, mSettings);
            for (const std::string& warning : mScene->fitted.warnings()) {
                log::warning("{}", warning);
            }
            mRenderer = std::make_unique<FrameRenderer>(mContext, mScene, mSettings);
            if (mMotion.moves()) {
                mDeformation =
                    std::make_unique<GpuDeformation>(mScene->shaders, mWorld, mScene->gpuWorld);
                mDeformation->apply(pose); // warms up
            }
        }
        if (!mDeformation) {
            return 0.0;
        }
        {
            const auto scope = mTimer.measure("deformation");
            mDeformation->apply(pose);
        }
        return mTimer.take().front().timeMs;
    }

    /// For what is said about the frame. Once the frame is made: it waits for the GPU.
    void learnBounds(const Pose& pose) {
        if (mDeformation) {
            const GpuDeformation::Bounds bounds = mDeformation->bounds(pose);
            mWorld.scatteringSphere = bounds.scattering;
            mWorld.sceneSphere = bounds.scene;
        }
    }
};

} // namespace

Command addRenderCommand(CLI::App& root) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        root.add_subcommand("render", "Renders stills and sequences; no display is needed");
    addRenderOptions(*command, *options);
    return {command, [options] {
                validateRenderOptions(*options);
                checkFiles(*options);
                render(*options);
            }};
}

void render(const RenderOptions& options) {
    const FrameRange frames = options.frames.value_or(FrameRange{});
    const FrameSettings settings = frameSettings(options);
    MaterialOverTime material(options);

    World first = readWorld(options, frames.first); // bad input is said before GL starts
    const Environment environment = environmentOf(options);
    static_cast<void>(makeMotion(first, motionOf(options)));
    const std::unique_ptr<gl::Context> context = gl::createContext(options.context);
    log::info("context {}: {}", context->description(), context->renderer());
    warnOfIdleOptions(options);
    RenderStats stats = statsHead(options, settings, *context);
    auto maker =
        std::make_unique<FrameMaker>(options, settings, *context, environment, std::move(first));
    Progress progress("frames", static_cast<std::size_t>(frames.count()));
    for (int number = frames.first; number <= frames.last; ++number) {
        if (options.sequence && number > frames.first) {
            maker.reset();
            maker = std::make_unique<FrameMaker>(options, settings, *context, environment,
                                                 readWorld(options, number));
        }
        if (MaterialPointer now = material.at(number)) {
            maker->setMaterial(std::move(now));
        }
        RenderedFrame frame = maker->make(number);
        stats.millimetersPerUnit = maker->millimetersPerUnit();
        stats.irradianceSize = maker->irradianceSize();
        if (options.solver == Solver::Splatting) {
            stats.backend = backendName(maker->backend());
        }
        stats.frames.push_back(frame.stats);
        writePicture(options, outputOfFrame(options, number), std::move(frame.image));
        progress.update(static_cast<std::size_t>(number - frames.first + 1));
    }
    for (const std::string& message : context->takeDebugMessages()) {
        log::warning("OpenGL: {}", message);
    }
    if (options.stats) {
        writeFileAtomically(*options.stats, toJson(stats));
    }
}

} // namespace celadon::app
