#include "subedit/texel_energy.h"

#include "subedit/fast_exp.h"
#include "subedit/fast_log.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

/// Sums over the segments of each channel, eight segments side by side: one sum after the other
/// would each wait for the one before.
CELADON_MULTIVERSION void addUpChannels(const float* __restrict energy, int count,
                                        float* __restrict total) {
    constexpr int kAtOnce = 24;
    Eight sums[3] = {};
    int i = 0;
    for (; i + kAtOnce <= count; i += kAtOnce) {
        for (int j = 0; j < 3; ++j) {
            Eight next;
            std::memcpy(&next, energy + i + 8 * j, sizeof(next));
            sums[j] += next;
        }
    }
    float sum[kAtOnce];
    std::memcpy(sum, sums, sizeof(sum));
    for (int j = 0; i + j < count; ++j) {
        sum[j] += energy[i + j];
    }
    for (int channel = 0; channel < 3; ++channel) {
        const float* const s = sum + channel;
        total[channel] = ((s[0] + s[12]) + (s[6] + s[18])) + ((s[3] + s[15]) + (s[9] + s[21]));
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
    addUp();
}

void TexelEnergy::computeFirst(const float* logProfile) {
    computeEnergies(logProfile, 3, mIndex.data(), mValue.data(), mEnergy.data());
    addUp();
}

void TexelEnergy::addUp() {
    addUpChannels(mEnergy.data(), mSegments * 3, mTotal.data());
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

float TexelEnergy::radiusBound(int channel, float fraction, float blackTotal) const {
    if (mTotal[channel] < blackTotal) {
        return 0.0f;
    }
    float remaining = mTotal[channel] * fraction;
    return static_cast<float>(segmentHolding(channel, remaining) + 1);
}

float TexelEnergy::radius(const float* logProfile, float fraction, float blackTotal) const {
    // Only channels that reach into the farthest segment can be the largest.
    int farthest = -1;
    std::array<int, 3> segment;
    std::array<float, 3> remaining;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        segment[channel] = -1;
        if (mTotal[channel] >= blackTotal) {
            remaining[channel] = mTotal[channel] * fraction;
            segment[channel] = segmentHolding(static_cast<int>(channel), remaining[channel]);
            farthest = std::max(farthest, segment[channel]);
        }
    }
    float largest = 0.0f;
    for (std::size_t channel = 0; channel < 3 && farthest >= 0; ++channel) {
        if (segment[channel] == farthest) {
            largest = std::max(largest, static_cast<float>(farthest) +
                                            invert(logProfile, farthest, static_cast<int>(channel),
                                                   remaining[channel]));
        }
    }
    return largest;
}

/// Newton inside a bracket, from where the energy would be if its density (k + t) e^(b t) were an
/// exponential: that of the same logarithmic slope at the middle.
float TexelEnergy::invert(const float* logProfile, int k, int channel, float energy) const {
    const int i = k * 3 + channel;
    if (energy >= mEnergy[i]) {
        return 1.0f;
    }
    const float p0 = mValue[i];
    const float b = logProfile[i + 3] - logProfile[i];
    const float start = static_cast<float>(k);
    const float part = energy / mEnergy[i];
    // From r = 0 the density rises as r does, and the energy as its square.
    const float slope = b + 1.0f / (start + 0.5f);
    const float e = fastExp(slope);
    float t = k == 0                    ? std::sqrt(part)
              : std::abs(slope) < 1e-2f ? part
                                        : fastLog(1.0f + part * (e - 1.0f)) / slope;
    t = std::clamp(t, 1e-3f, 0.999f);
    float low = 0.0f;
    float high = 1.0f;
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
        const bool isNewton = next > low && next < high;
        if (!isNewton) {
            next = 0.5f * (low + high);
        }
        // Each step squares the error: after one this small nothing is left to gain.
        const bool converged = isNewton && std::abs(next - t) < 1e-3f * (start + next);
        t = next;
        if (converged) {
            break;
        }
    }
    return t;
}

} // namespace celadon::subedit
