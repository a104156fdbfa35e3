#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/gl/context.h"
#include "renderer/gpu_materials.h"
#include "renderer/output/frame_stats.h"
#include "renderer/output/image.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/world.h"
#include "renderer/splatting/splatting_settings.h"

#include <memory>
#include <span>

/// One way through the program: world and camera in, lit geometry, exitance, shading, picture out.
namespace celadon {

enum class SolverKind { Splatting, ImageReference, SurfaceReference };

struct FrameSettings {
    glm::ivec2 size{800, 600};
    SolverKind solver = SolverKind::Splatting;
    SplattingSettings splatting;
    ExitFresnel exitFresnel = ExitFresnel::Exact;
    bool pointSamples = false; ///< image-reference: texels as points, the paper's
    bool specular = true;
    int coverageSamples = 4;
    int shadowSize = 1024;
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

class FrameRenderer {
public:
    /// @throws ContextError, InputError, ShaderError
    FrameRenderer(const gl::Context& context, const World& world, const FrameSettings& settings);
    ~FrameRenderer();

    /// @param camera in mm @param lights positions in mm
    [[nodiscard]] RenderedFrame render(const Camera& camera, std::span<const Light> lights);

    /// For tests and for views that explain: the solver and its buffers.
    [[nodiscard]] ExitanceSolver& solver();

private:
    struct Passes;
    std::unique_ptr<Passes> mPasses;
};

} // namespace celadon
