#pragma once

#include "renderer/exitance_solver.h"
#include "renderer/splatting/light_views.h"

/// Steps 1 (light side) to 4 of the paper as one exchangeable part: light views in, B of every
/// pixel out. All backends have one meaning and agree to 1e-3.
namespace celadon {

class SplatBackend {
public:
    virtual ~SplatBackend() = default;

    /// B of every level becomes zero. The splatting buffer is drawn, without mips.
    virtual void begin(const SolveInput& input) = 0;
    /// Adds one light view; the frame, bounds, material, solve and light blocks are bound. Where
    /// the view is not in use nothing is added: its draws and dispatches are without effect.
    virtual void add(const SolveInput& input, const LightViews& lightViews, int view,
                     gl::StageTimer& timer) = 0;
    /// After the last light view: adds coarser levels to finer ones. Level 0 of exitance() is
    /// complete then.
    virtual void finish(const SolveInput& input) = 0;

    /// See ExitanceSolver.
    virtual void materialChanged(const MaterialChange&) {}

    /// RGBA32F with the levels of the splatting buffer: B in W/m^2 from a level's ring on outwards;
    /// alpha sums up to the pairs.
    [[nodiscard]] virtual gl::Texture& exitance() = 0;

    /// Adds samples and flux of the last light view. May read back.
    virtual void count(FrameStats& statistics) = 0;
};

} // namespace celadon
