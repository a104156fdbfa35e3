#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/splatting/light_views.h"

/// Steps 1 (light side), 2 and 3 of the paper as one exchangeable part: a light view in, B of every
/// level of the splatting buffer out. All backends have one meaning and agree to 1e-3.
namespace celadon {

class SplatBackend {
public:
    virtual ~SplatBackend() = default;

    /// B of every level becomes zero. The splatting buffer and its mips are drawn.
    virtual void begin(const SolveInput& input) = 0;
    /// Adds one light view; the frame, bounds, material, solve and light blocks are bound. Where
    /// the view is not in use nothing is added: its draws and dispatches are without effect.
    virtual void add(const SolveInput& input, const LightViews& lightViews, int view,
                     gl::StageTimer& timer) = 0;
    /// After the last light view: exitance() is complete.
    virtual void finish() {}

    /// See ExitanceSolver.
    virtual void materialChanged(const MaterialChange&) {}

    /// RGBA32F with the levels of the splatting buffer: B^k in W/m^2; alpha sums up to the pairs.
    [[nodiscard]] virtual gl::Texture& exitance() = 0;

    /// Adds samples and flux of the last light view. May read back.
    virtual void count(FrameStats& statistics) = 0;
};

} // namespace celadon
