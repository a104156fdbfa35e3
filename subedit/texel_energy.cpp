#include "subedit/texel_energy.h"

#include "subedit/fast_exp.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

/// Moments M_0 and M_1 of log_linear.h for |z| < 0.3, to 1e-6.
float momentSeries0(float z) {
    return 1.0f + z * (1.0f / 2 + z * (1.0f / 6 + z * (1.0f / 24 + z / 120)));
}

float momentSeries1(float z) {
    return 1.0f / 2 + z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z / 144)));
}

/// P at all knots, and energies of all segments in units of h^2 (log_linear.h with t = 1). Both
/// branches of each moment are computed, so that the loops vectorize.
/// @param count segments x 3
/// @param index of the segment, for each of `count`
CELADON_MULTIVERSION void computeEnergies(const float* __restrict logProfile, int count,
                                          const float* __restrict index, float* __restrict value,
                                          float* __restrict energy) {
    for (int i = 0; i < count + 3; ++i) {
        value[i] = fastExp(logProfile[i]);
    }
    for (int i = 0; i < count; ++i) {
        const float z = logProfile[i + 3] - logProfile[i];
        const float p0 = value[i];
        const float p1 = value[i + 3];
        const bool isSmall = std::abs(z) < 0.3f;
        const float inverse = 1.0f / (isSmall ? 1.0f : z);
        const float m0 = (p1 - p0) * inverse;
        const float m1 = (p1 - m0) * inverse;
        const float s0 = p0 * momentSeries0(z);
        const float s1 = p0 * momentSeries1(z);
        energy[i] = index[i] * (isSmall ? s0 : m0) + (isSmall ? s1 : m1);
    }
}

} // namespace

TexelEnergy::TexelEnergy(int segments) : mSegments(segments) {
    for (int i = 0; i < segments * 3; ++i) {
        mIndex[static_cast<std::size_t>(i)] = static_cast<float>(i / 3);
    }
}

void TexelEnergy::compute(const float* logProfile) {
    const int count = mSegments * 3;
    computeEnergies(logProfile, count, mIndex.data(), mValue.data(), mEnergy.data());
    mTotal = {};
    for (int i = 0; i < count; i += 3) {
        mTotal[0] += mEnergy[i];
        mTotal[1] += mEnergy[i + 1];
        mTotal[2] += mEnergy[i + 2];
    }
}

int TexelEnergy::segmentHolding(int channel, float& remaining) const {
    int k = 0;
    while (k < mSegments - 1 && remaining > mEnergy[k * 3 + channel]) {
        remaining -= mEnergy[k * 3 + channel];
        ++k;
    }
    return k;
}

float TexelEnergy::channelRadius(const float* logProfile, int channel, float fraction,
                                 float blackTotal) const {
    if (mTotal[channel] < blackTotal) {
        return 0.0f;
    }
    float remaining = mTotal[channel] * fraction;
    const int k = segmentHolding(channel, remaining);
    return static_cast<float>(k) + invert(logProfile, k, channel, remaining);
}

float TexelEnergy::radius(const float* logProfile, float fraction, float blackTotal) const {
    float largest = 0.0f;
    for (int channel = 0; channel < 3; ++channel) {
        if (mTotal[channel] < blackTotal) {
            continue;
        }
        float remaining = mTotal[channel] * fraction;
        const int k = segmentHolding(channel, remaining);
        if (static_cast<float>(k + 1) > largest) { // else another channel reaches farther
            largest = std::max(largest,
                               static_cast<float>(k) + invert(logProfile, k, channel, remaining));
        }
    }
    return largest;
}

/// Newton from the point where the energy would be with P constant, inside a bracket.
float TexelEnergy::invert(const float* logProfile, int k, int channel, float energy) const {
    const int i = k * 3 + channel;
    const float p0 = mValue[i];
    const float b = logProfile[i + 3] - logProfile[i];
    const float start = static_cast<float>(k);
    if (energy >= mEnergy[i]) {
        return 1.0f;
    }
    float low = 0.0f;
    float high = 1.0f;
    float t = std::clamp(energy / mEnergy[i], 0.05f, 0.95f);
    for (int iteration = 0; iteration < 12; ++iteration) {
        const float z = b * t;
        const float p = p0 * fastExp(z);
        float m0 = 0.0f;
        float m1 = 0.0f;
        if (std::abs(z) < 0.3f) {
            m0 = p0 * momentSeries0(z);
            m1 = p0 * momentSeries1(z);
        } else {
            m0 = (p - p0) / z;
            m1 = (p - m0) / z;
        }
        const float excess = t * (start * m0 + t * m1) - energy;
        (excess > 0.0f ? high : low) = t;
        float next = t - excess / std::max(p * (start + t), 1e-30f);
        if (!(next > low && next < high)) {
            next = 0.5f * (low + high);
        }
        const bool converged = std::abs(next - t) < 1e-5f * (start + next);
        t = next;
        if (converged) {
            break;
        }
    }
    return t;
}

} // namespace celadon::subedit
