#pragma once

#include "renderer/gl/texture.h"
#include "renderer/gl/timer.h"
#include "renderer/output/frame_stats.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/world.h"
#include "subedit/map/texel_rect.h"

#include <atomic>
#include <cstdint>
#include <span>

/// The one seam of the renderer: lit geometry, view and material in, radiant exitance B of every
/// visible pixel out (Chen et al. 2012, eq. 5). Splatting and each reference is one solver;
/// buffers, shading and output are shared by all.
namespace celadon {

class GpuWorld;
class GpuMaterials;
class SplattingBuffer;

struct SolveInput {
    const World& world;            ///< geometry on the CPU, for references that trace rays
    const GpuWorld& gpuWorld;      ///< geometry and bounds as they are now
    const GpuMaterials& materials; ///< bound
    SplattingBuffer& view;         ///< level 0 drawn; its frame block and the bounds bound
    const CameraView& camera;
    std::span<const Light> lights; ///< positions in mm
    /// Set from another thread when nobody waits for the result any more: a solver may then return
    /// early, with anything. Null: never.
    const std::atomic<bool>* interrupt = nullptr;
    std::uint64_t geometry = 0; ///< another number once vertices have moved

    [[nodiscard]] bool isInterrupted() const {
        return interrupt != nullptr && interrupt->load(std::memory_order_relaxed);
    }
};

struct MaterialChange {
    int material = 0;
    subedit::TexelRect rect;
    float largestLogP = 0.0f; ///< within the rectangle
};

class ExitanceSolver {
public:
    virtual ~ExitanceSolver() = default;

    /// Levels that the splatting buffer must have.
    [[nodiscard]] virtual int viewLevels() const = 0;

    /// @return B in W/m^2 at pixel centers, RGBA32F, rows from the bottom; valid until the next
    /// call
    /// @param timer receives the stages "irradianceBuffer", "splattingBuffer", "selection",
    ///              "splatting N", "accumulation", as far as the solver has them
    virtual const gl::Texture& solve(const SolveInput& input, gl::StageTimer& timer) = 0;

    /// Texels of a material were edited in place.
    virtual void materialChanged(const MaterialChange&) {}

    /// Samples, pairs and flux of the last solve. May read back: not within a timed frame.
    virtual void report(FrameStats& stats) = 0;
};

} // namespace celadon
