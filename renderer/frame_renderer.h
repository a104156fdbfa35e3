#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/fitted_materials.h"
#include "renderer/gl/context.h"
#include "renderer/gl/shader_library.h"
#include "renderer/gpu_materials.h"
#include "renderer/gpu_world.h"
#include "renderer/output/frame_stats.h"
#include "renderer/output/image.h"
#include "renderer/reference/path_traced_settings.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/world.h"
#include "renderer/splatting/splatting_settings.h"

#include <memory>
#include <span>

/// One way through the program: world and camera in, lit geometry, exitance, shading, picture out.
namespace celadon {

enum class SolverKind { Splatting, ImageReference, SurfaceReference, PathTraced };

/// Whether a solver traces rays: it takes the world as it stands on the CPU, so that a moved one
/// must be posed there.
[[nodiscard]] constexpr bool tracesRays(SolverKind solver) {
    return solver == SolverKind::SurfaceReference || solver == SolverKind::PathTraced;
}

struct FrameSettings {
    glm::ivec2 size{800, 600};
    SolverKind solver = SolverKind::Splatting;
    SplattingSettings splatting;
    ExitFresnel exitFresnel = ExitFresnel::Exact;
    bool pointSamples = false; ///< image-reference: texels as points, the paper's
    PathTracedSettings pathTraced;
    /// References by eq. 4 and 5: of the picture's blocks of 8 x 8 pixels one in so many is
    /// computed, chosen as by chance (isReferencePixel); the others are black.
    int referenceBlocks = 1;
    bool specular = true;
    int coverageSamples = 4;
    /// Of normal and view, for the Fresnel term of what is seen: without antialiasing, pixels at
    /// silhouettes would be dark dots.
    double leastCosine = 0.0;
    int shadowSize = 1024;
    Rasterizer rasterizer = Rasterizer::Auto;
    bool shadows = true;     ///< of highlights and of what falls on opaque parts
    bool layers = false;     ///< read back what --aov writes
    bool statistics = false; ///< render a warm-up frame, count samples, pairs and flux
};

struct RenderedFrame {
    /// R,G,B,A, top row first, linear radiance in W/m^2/sr, premultiplied; with layers also
    /// exitance.{R,G,B} position.{X,Y,Z} normal.{X,Y,Z} uv.{X,Y} radius level at pixel centers,
    /// zero where nothing is seen.
    FloatImage image;
    FrameStats stats;
    bool seesScattering = false; ///< some pixel's center sees scattering surface
};

/// Geometry and materials on the GPU. Renderers of several sizes and qualities may share it, as
/// long as their settings agree on `energy`, `epsilon`, `exitFresnel` and `rasterizer`.
struct GpuScene {
    /// @param theWorld outlives the scene @param tell of GpuMaterials
    /// @throws ContextError, InputError
    GpuScene(const World& theWorld, const FrameSettings& settings, const MakingProgress& tell = {});

    /// Texels of a material of the world were edited in place.
    /// @return what every renderer's solver is to be told: ExitanceSolver::materialChanged()
    [[nodiscard]] MaterialChange materialChanged(int material, const subedit::TexelRect& rect);

    const World& world;
    gl::ShaderLibrary shaders;
    GpuWorld gpuWorld;
    FittedMaterials fitted;
    GpuMaterials materials; ///< of fitted.maps()
};

class FrameRenderer {
public:
    /// @throws ContextError, InputError, ShaderError
    FrameRenderer(const gl::Context& context, const World& world, const FrameSettings& settings);
    FrameRenderer(const gl::Context& context, std::shared_ptr<const GpuScene> scene,
                  const FrameSettings& settings);
    ~FrameRenderer();

    /// What is around the scene from the next frame on; nothing at first. Highlights see it as it
    /// is; for what scatters, and for opaque parts, its lights (environmentLights) are added to a
    /// frame's.
    void setEnvironment(const Environment& environment);

    /// @param camera in mm @param lights positions in mm
    [[nodiscard]] RenderedFrame render(const Camera& camera, std::span<const Light> lights);

    /// The same for a window: nothing is read back, and what depends on neither camera nor lights
    /// that moved is kept: the visible surface, highlights and, on the cpu backend, the scattered
    /// light that no change of a material reaches. Whoever moves vertices says so with
    /// geometryChanged(), whoever edits a material with GpuScene::materialChanged().
    /// @param interrupt see SolveInput; may be null
    /// @return RGBA32F, rows from the bottom, linear radiance, premultiplied; valid until the next
    ///         call. Null when interrupted.
    const gl::Texture* draw(const Camera& camera, std::span<const Light> lights,
                            const std::atomic<bool>* interrupt);
    /// Vertices were moved since the last draw().
    void geometryChanged();
    /// Times of draw()s since the last call. Waits for the GPU.
    [[nodiscard]] StageMilliseconds takeTimes();
    /// N of the light views, once refined for the scene (refinedIrradianceSize).
    [[nodiscard]] int irradianceSize() const;
    /// The visible surface of the last frame.
    [[nodiscard]] const SplattingBuffer& view() const;
    /// B of the last frame at pixel centers, W/m^2; its mips are B^k accumulated.
    [[nodiscard]] const gl::Texture& exitance() const;

    /// What splats, once a frame was drawn with the splatting solver.
    [[nodiscard]] SplatBackendKind backend() const;
    /// For tests and for views that explain: the solver and its buffers.
    [[nodiscard]] ExitanceSolver& solver();

private:
    struct Passes;
    std::unique_ptr<Passes> mPasses;
};

} // namespace celadon
