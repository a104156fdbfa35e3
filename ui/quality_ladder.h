#pragma once

#include "renderer/frame_quality.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

/// Which picture to render next: a coarse one while something moves, so that the frame rate holds;
/// finer and finer ones at rest. Times are measured, nothing is assumed about the machine. No GL.
namespace celadon::ui {

/// One way to render the viewport.
struct Rung {
    int divisor = 1; ///< window pixels per rendered pixel, on a side
    Quality quality = Quality::Default;
    int samples = 1; ///< coverage samples a pixel
};

class QualityLadder {
public:
    /// @param budgetMs what a frame may take while something moves
    explicit QualityLadder(double budgetMs = 100.0);

    [[nodiscard]] const std::vector<Rung>& rungs() const { return mRungs; }

    /// The finest rung that is expected to hold the budget. At most one rung finer than the finest
    /// that was ever measured: what is unknown is tried step by step.
    [[nodiscard]] int movingRung(glm::ivec2 sizePx) const;
    /// What comes after `shown` at rest; nothing after the last.
    /// @param shown rung of the picture on screen, -1: none
    [[nodiscard]] std::optional<int> nextRung(int shown, glm::ivec2 sizePx) const;

    void measured(int rung, glm::ivec2 sizePx, double timeMs);
    /// A picture that also compiled shaders and filled its buffers: half of its time or so is
    /// taken, until there is a better one.
    void measuredFirst(int rung, glm::ivec2 sizePx, double timeMs);
    /// Another scene: times mean nothing any more.
    void forget();

    /// Expected time of a rung; from those that were measured where it was not.
    [[nodiscard]] double expectedMs(int rung, glm::ivec2 sizePx) const;

private:
    std::vector<Rung> mRungs;
    std::vector<double> mMsPerCost; ///< per rung; 0: not measured
    double mBudgetMs;
};

} // namespace celadon::ui
