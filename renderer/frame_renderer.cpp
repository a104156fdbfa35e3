#include "renderer/frame_renderer.h"

#include "renderer/frame_layers.h"
#include "renderer/reference/reference_solvers.h"
#include "renderer/shading/antialiasing.h"
#include "renderer/shading/direct_light.h"
#include "renderer/shading/shading_pass.h"
#include "renderer/splatting/splatting_solver.h"

#include <string>
#include <utility>

namespace celadon {

namespace {

/// Adds stage times by name to where `--stats` has them.
StageMilliseconds sumStages(const std::vector<gl::StageTime>& stages, int splattingLevels) {
    StageMilliseconds sum;
    sum.deformation = 0.0;
    sum.irradianceBuffer = sum.splattingBuffer = sum.selection = 0.0;
    sum.accumulation = sum.shading = sum.total = 0.0;
    sum.splatting.assign(static_cast<std::size_t>(splattingLevels), 0.0);
    for (const gl::StageTime& stage : stages) {
        sum.total += stage.timeMs;
        if (stage.stage.starts_with("splatting ")) {
            sum.splatting[static_cast<std::size_t>(std::stoi(stage.stage.substr(10)))] +=
                stage.timeMs;
        } else if (stage.stage == "irradianceBuffer") {
            sum.irradianceBuffer += stage.timeMs;
        } else if (stage.stage == "splattingBuffer") {
            sum.splattingBuffer += stage.timeMs;
        } else if (stage.stage == "selection") {
            sum.selection += stage.timeMs;
        } else if (stage.stage == "accumulation") {
            sum.accumulation += stage.timeMs;
        } else if (stage.stage == "shading") {
            sum.shading += stage.timeMs;
        }
    }
    return sum;
}

/// All that the visible surface depends on besides the world and the settings.
std::vector<double> viewKey(const Camera& camera) {
    const glm::dvec3& eye = camera.eye;
    const glm::dvec3& at = camera.at;
    const glm::dvec3& up = camera.up;
    return {eye.x,
            eye.y,
            eye.z,
            at.x,
            at.y,
            at.z,
            up.x,
            up.y,
            up.z,
            camera.fovYDegrees,
            camera.orthographicHeight.value_or(-1.0)};
}

/// The same for direct light.
std::vector<double> directLightKey(const Camera& camera, std::span<const Light> lights) {
    std::vector<double> key = viewKey(camera);
    const auto add = [&key](const glm::dvec3& v) {
        for (int c = 0; c < 3; ++c) {
            key.push_back(v[c]);
        }
    };
    for (const Light& light : lights) {
        key.push_back(static_cast<double>(light.kind));
        add(light.position);
        add(light.direction);
        add(light.color);
        key.push_back(light.innerConeRadians);
        key.push_back(light.outerConeRadians);
    }
    return key;
}

} // namespace

GpuScene::GpuScene(const World& theWorld, const FrameSettings& settings, const MakingProgress& tell)
    : world(theWorld),
      gpuWorld(theWorld, settings.rasterizer),
      fitted(theWorld.materials, GpuMaterials::hasRoom,
             tell ? [&tell] { tell(0.0f); } : std::function<void()>()),
      materials(fitted.maps(), settings.splatting.energy, settings.splatting.epsilon,
                settings.exitFresnel, tell, settings.splatting.rangeTable) {
    shaders.define(sceneDefines(theWorld, gpuWorld.rasterizer()));
}

MaterialChange GpuScene::materialChanged(int material, const subedit::TexelRect& rect) {
    const MaterialChange change =
        fitted.update(material, *world.materials[static_cast<std::size_t>(material)], rect);
    materials.update(material, *fitted.maps()[static_cast<std::size_t>(material)], change.rect);
    return change;
}

struct FrameRenderer::Passes {
    Passes(const gl::Context& glContext, std::shared_ptr<const GpuScene> theScene,
           const FrameSettings& theSettings)
        : scene(std::move(theScene)),
          world(scene->world),
          shaders(scene->shaders),
          gpuWorld(scene->gpuWorld),
          materials(scene->materials),
          settings(theSettings),
          timer(glContext),
          view(shaders, materials.count(), theSettings.size,
               theSettings.solver == SolverKind::Splatting
                   ? SplattingSolver::viewLevels(theSettings.splatting)
                   : 1),
          directLight(shaders, view, theSettings.shadowSize),
          shading(shaders, materials.count(), view, theSettings.leastCosine),
          antialiasing(settings.coverageSamples > 1
                           ? std::make_unique<Antialiasing>(shaders, view, settings.coverageSamples)
                           : nullptr) {
        const auto shortRadiusMm = static_cast<double>(materials.shortRadiusMm());
        const double diameterMm = 2.0 * world.scatteringSphere.radius;
        settings.splatting.irradianceSize =
            refinedIrradianceSize(settings.splatting, shortRadiusMm, diameterMm);
        settings.splatting.patchVariance =
            refinedPatchVariance(settings.splatting, shortRadiusMm, diameterMm);
        switch (settings.solver) {
        case SolverKind::Splatting:
            settings.splatting.backend = resolveBackend(settings.splatting.backend, glContext);
            solver = std::make_unique<SplattingSolver>(shaders, scene->fitted.maps(), materials,
                                                       view, settings.splatting);
            break;
        case SolverKind::ImageReference:
            solver = std::make_unique<ImageReferenceSolver>(
                shaders, materials.count(), settings.splatting.irradianceSize,
                settings.pointSamples, settings.referenceBlocks);
            break;
        case SolverKind::SurfaceReference:
            solver = std::make_unique<SurfaceReferenceSolver>(world, settings.referenceBlocks);
            break;
        case SolverKind::PathTraced:
            solver = std::make_unique<PathTracedSolver>(world, settings.pathTraced);
            break;
        }
    }

    /// @return whether the frame is complete
    bool draw(const Camera& camera, std::span<const Light> lights,
              const std::atomic<bool>* interrupt = nullptr);

    std::shared_ptr<const GpuScene> scene;
    const World& world;
    const gl::ShaderLibrary& shaders;
    const GpuWorld& gpuWorld;
    const GpuMaterials& materials;
    FrameSettings settings;
    gl::StageTimer timer;
    SplattingBuffer view;
    std::unique_ptr<ExitanceSolver> solver;
    DirectLight directLight;
    ShadingPass shading;
    std::unique_ptr<Antialiasing> antialiasing; ///< null: pixel centers as they are
    Environment environment;
    std::vector<Light> aroundLights;                         ///< that stand for it
    std::unique_ptr<const EnvironmentReflection> reflection; ///< of environment.map
    CameraView cameraView;
    const gl::Texture* exitance = nullptr;
    const gl::Texture* color = nullptr;
    std::uint64_t geometry = 0;    ///< as SolveInput
    std::vector<double> drawnKey;  ///< what the view was drawn for
    std::vector<double> shadedKey; ///< what the direct light was shaded for
};

bool FrameRenderer::Passes::draw(const Camera& camera, std::span<const Light> ownLights,
                                 const std::atomic<bool>* interrupt) {
    std::vector<Light> lights(ownLights.begin(), ownLights.end());
    lights.insert(lights.end(), aroundLights.begin(), aroundLights.end());
    cameraView = makeCameraView(camera, settings.size.x, settings.size.y);
    materials.bind();
    {
        const auto scope = timer.measure("splattingBuffer");
        // While only materials change, as under a brush, the same surface is seen.
        std::vector<double> key = viewKey(camera);
        if (key == drawnKey) {
            view.bind(gpuWorld);
            view.refreshRadii();
        } else {
            const auto places =
                antialiasing ? antialiasing->placesToSee() : std::span<const glm::vec2>();
            const TriangleRaster* const seen = view.draw(gpuWorld, cameraView, places);
            if (seen != nullptr && antialiasing) {
                antialiasing->take(gpuWorld, *seen, view);
            }
            drawnKey = std::move(key);
        }
    }
    const SolveInput input{world,      gpuWorld, materials, view,
                           cameraView, lights,   interrupt, geometry};
    exitance = &solver->solve(input, timer);
    if (input.isInterrupted()) {
        return false;
    }
    const auto scope = timer.measure("shading");
    // Neither do highlights change then.
    std::vector<double> key = directLightKey(camera, lights);
    if (key != shadedKey) {
        const DirectLight::Surroundings around{reflection.get(), environment, ownLights.size()};
        directLight.shade(lights, gpuWorld, view, settings.specular, settings.shadows,
                          reflection ? &around : nullptr);
        shadedKey = std::move(key);
    }
    shading.shade(view, *exitance, directLight.radiance());
    color = &shading.radiance();
    if (antialiasing != nullptr) {
        antialiasing->resolve(gpuWorld, camera, view, shading.radiance());
        color = &antialiasing->color();
    }
    return true;
}

FrameRenderer::FrameRenderer(const gl::Context& context, const World& world,
                             const FrameSettings& settings)
    : FrameRenderer(context, std::make_shared<const GpuScene>(world, settings), settings) {}

FrameRenderer::FrameRenderer(const gl::Context& context, std::shared_ptr<const GpuScene> scene,
                             const FrameSettings& settings)
    : mPasses(std::make_unique<Passes>(context, std::move(scene), settings)) {}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::setEnvironment(const Environment& environment) {
    Passes& passes = *mPasses;
    if (environment == passes.environment) {
        return;
    }
    const Environment before = std::exchange(passes.environment, environment);
    passes.aroundLights = environmentLights(environment);
    if (!environment || !passes.settings.specular) {
        passes.reflection.reset();
    } else if (!passes.reflection || before.map != environment.map) {
        passes.reflection =
            std::make_unique<EnvironmentReflection>(passes.shaders, *environment.map);
    }
    passes.shadedKey.clear();
}

int FrameRenderer::irradianceSize() const {
    return mPasses->settings.splatting.irradianceSize;
}

ExitanceSolver& FrameRenderer::solver() {
    return *mPasses->solver;
}

SplatBackendKind FrameRenderer::backend() const {
    const auto* splatting = dynamic_cast<const SplattingSolver*>(mPasses->solver.get());
    return splatting != nullptr ? splatting->backend() : mPasses->settings.splatting.backend;
}

const SplattingBuffer& FrameRenderer::view() const {
    return mPasses->view;
}

const gl::Texture& FrameRenderer::exitance() const {
    return *mPasses->exitance;
}

StageMilliseconds FrameRenderer::takeTimes() {
    return sumStages(mPasses->timer.take(), mPasses->view.levels());
}

const gl::Texture* FrameRenderer::draw(const Camera& camera, std::span<const Light> lights,
                                       const std::atomic<bool>* interrupt) {
    return mPasses->draw(camera, lights, interrupt) ? mPasses->color : nullptr;
}

void FrameRenderer::geometryChanged() {
    mPasses->drawnKey.clear();
    mPasses->shadedKey.clear();
    ++mPasses->geometry;
}

RenderedFrame FrameRenderer::render(const Camera& camera, std::span<const Light> lights) {
    RenderedFrame frame;
    const auto drawWhole = [&] {
        geometryChanged(); // it may have; and a frame is timed as a whole
        mPasses->draw(camera, lights);
    };
    auto* splatting = dynamic_cast<SplattingSolver*>(mPasses->solver.get());
    if (mPasses->settings.statistics && splatting != nullptr) {
        splatting->collectStatistics(true); // the warm-up frame counts, the second is timed
        drawWhole();
        splatting->report(frame.stats);
        splatting->collectStatistics(false);
        static_cast<void>(mPasses->timer.take());
    }
    drawWhole();
    frame.stats.milliseconds = sumStages(mPasses->timer.take(), mPasses->view.levels());
    if (splatting == nullptr) {
        mPasses->solver->report(frame.stats);
    }
    readFrame(mPasses->view, *mPasses->exitance, *mPasses->color, mPasses->cameraView,
              mPasses->materials, mPasses->settings.layers, frame);
    return frame;
}

} // namespace celadon
