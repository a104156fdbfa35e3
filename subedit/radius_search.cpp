#include "subedit/radius_search.h"

#include "subedit/fast_exp.h"
#include "subedit/fast_log.h"
#include "subedit/moment_series.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace celadon::subedit {

void RadiusSearch::add(const Segment& segment, float& radius) {
    if (segment.wanted >= segment.energy) {
        radius = std::max(radius, segment.index + 1.0f);
        return;
    }
    const auto lane = static_cast<std::size_t>(mCount++);
    mLanes.index[lane] = segment.index;
    mLanes.p0[lane] = segment.p0;
    mLanes.slope[lane] = segment.slope;
    mLanes.energy[lane] = segment.energy;
    mLanes.part[lane] = segment.wanted / segment.energy;
    mRadii[lane] = &radius;
    if (mCount == kLanes) {
        finish();
    }
}

void RadiusSearch::finish() {
    if (mCount == 0) {
        return;
    }
    for (auto lane = static_cast<std::size_t>(mCount); lane < kLanes; ++lane) {
        mLanes.index[lane] = mLanes.index[0]; // an answer that is found as soon as the first
        mLanes.p0[lane] = mLanes.p0[0];
        mLanes.slope[lane] = mLanes.slope[0];
        mLanes.energy[lane] = mLanes.energy[0];
        mLanes.part[lane] = mLanes.part[0];
    }
    solve(mLanes);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(mCount); ++lane) {
        *mRadii[lane] = std::max(*mRadii[lane], mLanes.index[lane] + mLanes.t[lane]);
    }
    mCount = 0;
}

/// Newton inside a bracket, from where the energy would be if its density (k + t) e^(b t) were an
/// exponential: that of the same logarithmic slope at the middle. Both branches are computed, so
/// that the loops vectorize.
CELADON_MULTIVERSION void RadiusSearch::solve(Lanes& lanes) {
    std::array<float, kLanes> low{};
    std::array<float, kLanes> high;
    std::array<std::int32_t, kLanes> isDone{};
    for (std::size_t i = 0; i < kLanes; ++i) {
        const float part = lanes.part[i];
        // From r = 0 the density rises as r does, and the energy as its square.
        const float slope = lanes.slope[i] + 1.0f / (lanes.index[i] + 0.5f);
        const bool isFlat = std::abs(slope) < 1e-2f;
        const float growth = fastLog(1.0f + part * (fastExp(slope) - 1.0f));
        float t = isFlat ? part : growth / (isFlat ? 1.0f : slope);
        t = lanes.index[i] == 0.0f ? std::sqrt(part) : t;
        t = t > 1e-3f ? t : 1e-3f;
        lanes.t[i] = t < 0.999f ? t : 0.999f;
        high[i] = 1.0f;
    }
    for (int iteration = 0; iteration < 12; ++iteration) {
        std::int32_t done = 1;
        for (std::size_t i = 0; i < kLanes; ++i) {
            const float start = lanes.index[i];
            const float p0 = lanes.p0[i];
            const float t = lanes.t[i];
            const float z = lanes.slope[i] * t;
            const float p = p0 * fastExp(z);
            const bool isSmall = std::abs(z) < 0.3f;
            const float inverse = 1.0f / (isSmall ? 1.0f : z);
            const float e0 = (p - p0) * inverse;
            const float m0 = isSmall ? p0 * momentSeries0(z) : e0;
            const float m1 = isSmall ? p0 * momentSeries1(z) : (p - e0) * inverse;
            const float excess = t * (start * m0 + t * m1) - lanes.part[i] * lanes.energy[i];
            high[i] = excess > 0.0f ? t : high[i];
            low[i] = excess > 0.0f ? low[i] : t;
            const float density = p * (start + t);
            const float newton = t - excess / (density > 1e-30f ? density : 1e-30f);
            const std::int32_t isNewton = (newton > low[i] ? 1 : 0) & (newton < high[i] ? 1 : 0);
            const float next = isNewton != 0 ? newton : 0.5f * (low[i] + high[i]);
            lanes.t[i] = isDone[i] != 0 ? t : next;
            // Each step squares the error: after one this small nothing is left to gain.
            isDone[i] |= isNewton & (std::abs(next - t) < 1e-3f * (start + next) ? 1 : 0);
            done &= isDone[i];
        }
        if (done != 0) {
            break;
        }
    }
}

} // namespace celadon::subedit
