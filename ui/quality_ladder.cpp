#include "ui/quality_ladder.h"

#include <algorithm>

namespace celadon::ui {

namespace {

constexpr double kPatienceMs = 900.0; ///< at rest, a first better picture comes within this time
/// Without one in between the default may take longer: together the two would take longer still.
constexpr double kDefaultPatienceMs = 3000.0;
constexpr double kFallback = 400.0;   ///< ms per unit of cost before anything was measured
constexpr double kShareOfFirst = 0.5; ///< of a first picture's time that later ones take
constexpr double kSmoothing = 0.5;    ///< weight of the latest time

/// Relative cost of a rung: texels of the light view and pixels of the picture both count.
double costOf(const Rung& rung, glm::ivec2 sizePx) {
    const double side = frameSettings(rung.quality).splatting.irradianceSize / 512.0;
    const double pixels = static_cast<double>(sizePx.x) * sizePx.y / (rung.divisor * rung.divisor);
    return 0.02 + side * side + pixels / 900e3 * (0.5 + 0.1 * rung.samples + side);
}

} // namespace

QualityLadder::QualityLadder(double budgetMs)
    : mRungs{{8, Quality::Sketch, 1}, {6, Quality::Sketch, 1},  {4, Quality::Sketch, 1},
             {3, Quality::Sketch, 1}, {2, Quality::Sketch, 1},  {2, Quality::Draft, 1},
             {1, Quality::Draft, 1},  {1, Quality::Default, 4}, {1, Quality::Final, 16}},
      mMsPerCost(mRungs.size(), 0.0),
      mBudgetMs(budgetMs) {}

double QualityLadder::expectedMs(int rung, glm::ivec2 sizePx) const {
    const auto index = static_cast<std::size_t>(rung);
    double msPerCost = kFallback;
    std::size_t nearest = mRungs.size();
    for (std::size_t i = 0; i < mRungs.size(); ++i) {
        const std::size_t distance = i > index ? i - index : index - i;
        if (mMsPerCost[i] > 0.0 && distance < nearest) {
            nearest = distance;
            msPerCost = mMsPerCost[i];
        }
    }
    return msPerCost * costOf(mRungs[index], sizePx);
}

int QualityLadder::movingRung(glm::ivec2 sizePx) const {
    int finestMeasured = 1;
    for (std::size_t i = 0; i < mRungs.size(); ++i) {
        if (mMsPerCost[i] > 0.0) {
            finestMeasured = static_cast<int>(i);
        }
    }
    const int last = std::min(static_cast<int>(mRungs.size()) - 1, finestMeasured + 1);
    int best = 0;
    for (int i = 1; i <= last; ++i) {
        if (expectedMs(i, sizePx) <= mBudgetMs) {
            best = i;
        }
    }
    return best;
}

std::optional<int> QualityLadder::nextRung(int shown, glm::ivec2 sizePx) const {
    const int last = static_cast<int>(mRungs.size()) - 1;
    if (shown >= last) {
        return std::nullopt;
    }
    if (shown < 0) {
        return movingRung(sizePx);
    }
    // The finest that still comes soon; where none does, the next one.
    int next = shown + 1;
    for (int i = next; i < last; ++i) { // the last is for those who wait
        const bool isDefault = mRungs[static_cast<std::size_t>(i)].quality == Quality::Default;
        if (expectedMs(i, sizePx) <= (isDefault ? kDefaultPatienceMs : kPatienceMs)) {
            next = i;
        }
    }
    return next;
}

void QualityLadder::measured(int rung, glm::ivec2 sizePx, double timeMs) {
    const auto index = static_cast<std::size_t>(rung);
    const double now = timeMs / costOf(mRungs[index], sizePx);
    double& known = mMsPerCost[index];
    known = known > 0.0 ? known + kSmoothing * (now - known) : now;
}

void QualityLadder::measuredFirst(int rung, glm::ivec2 sizePx, double timeMs) {
    if (mMsPerCost[static_cast<std::size_t>(rung)] == 0.0) {
        measured(rung, sizePx, kShareOfFirst * timeMs);
    }
}

void QualityLadder::forget() {
    std::fill(mMsPerCost.begin(), mMsPerCost.end(), 0.0);
}

} // namespace celadon::ui
