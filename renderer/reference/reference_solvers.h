#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/reference/patch.h"
#include "renderer/reference/path_traced.h"
#include "renderer/reference/surface_reference.h"
#include "renderer/splatting/irradiance_buffer.h"
#include "renderer/splatting/light_views.h"

#include <vector>

/// The references as solvers of the common seam (DESIGN section 4): exitance by brute force on the
/// CPU at the pixels that the splatting buffer sees. None is fast.
namespace celadon {

/// What both have in common: exit points from the view, the result as a texture.
class ReferenceSolver : public ExitanceSolver {
public:
    /// @param blocks see FrameSettings::referenceBlocks
    explicit ReferenceSolver(int blocks = 1) : mBlocks(blocks) {}
    [[nodiscard]] int viewLevels() const override { return 1; }
    const gl::Texture& solve(const SolveInput& input, gl::StageTimer& timer) override;
    void report(FrameStats& stats) override;

protected:
    /// B in W/m^2 of each exit point; adds to the statistics.
    virtual std::vector<glm::vec3> gather(const SolveInput& input,
                                          std::span<const ExitPoint> exitPoints,
                                          FrameStats& statistics) = 0;

private:
    int mBlocks;
    gl::Texture mExitance;
    FrameStats mStatistics;
};

/// Each lit texel of the light views' level 0, as a patch (or a point).
class ImageReferenceSolver final : public ReferenceSolver {
public:
    ImageReferenceSolver(const gl::ShaderLibrary& shaders, int materialCount, int irradianceSize,
                         bool pointSamples, int blocks);

protected:
    std::vector<glm::vec3> gather(const SolveInput& input, std::span<const ExitPoint> exitPoints,
                                  FrameStats& statistics) override;

private:
    LightViews mLightViews;
    IrradianceBuffer mIrradiance;
    bool mPointSamples;
};

/// Dense samples of the surface itself, ray-traced shadows, no light view.
class SurfaceReferenceSolver final : public ReferenceSolver {
public:
    SurfaceReferenceSolver(const World& world, int blocks)
        : ReferenceSolver(blocks), mReference(world) {}

protected:
    std::vector<glm::vec3> gather(const SolveInput& input, std::span<const ExitPoint> exitPoints,
                                  FrameStats& statistics) override;

private:
    SurfaceReference mReference;
};

/// Random walks in the body, whose medium is the settings': the materials play no part.
class PathTracedSolver final : public ReferenceSolver {
public:
    PathTracedSolver(const World& world, const PathTracedSettings& settings)
        : mPathTraced(world, settings) {}

protected:
    std::vector<glm::vec3> gather(const SolveInput& input, std::span<const ExitPoint> exitPoints,
                                  FrameStats& statistics) override;

private:
    PathTraced mPathTraced;
};

/// Whether a pixel belongs to a block of which references compute one in `blocks`; x from the left,
/// y from the bottom. Always for 1.
[[nodiscard]] bool isReferencePixel(int x, int y, int blocks);

/// Exit points of level 0 of a view, rows from the bottom; background has material -1.
[[nodiscard]] std::vector<ExitPoint> readExitPoints(const SplattingBuffer& view);

} // namespace celadon
