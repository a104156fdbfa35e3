#include "subedit/texel_energy.h"

#include "subedit/fast_exp.h"
#include "subedit/moment_series.h"
#include "subedit/multiversion.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace celadon::subedit {

namespace {

CELADON_MULTIVERSION void computeValues(const float* __restrict logProfile, int count,
                                        float* __restrict value) {
    for (int i = 0; i < count; ++i) {
        value[i] = fastExp(logProfile[i]);
    }
}

/// Energies of segments in units of h^2 (log_linear.h with t = 1), from ln P and P at the knots,
/// both also at the knot after the last. Both branches of each moment are computed, so that the
/// loop vectorizes.
/// @param index of the segment, for each of `count`
CELADON_MULTIVERSION void computeEnergies(const float* __restrict logProfile,
                                          const float* __restrict value,
                                          const float* __restrict index, int count,
                                          float* __restrict energy) {
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
    // As far as whole vectors reach.
    const int used = wholeVectors((segments + 1) * 3) + kLanes;
    for (auto* values : {&mIndex, &mLog, &mValue, &mEnergy}) {
        std::fill_n(values->begin(), used, 0.0f);
    }
    for (int k = 0; k < segments; ++k) {
        std::fill_n(mIndex.begin() + 3 * k, 3, static_cast<float>(k));
    }
}

void TexelEnergy::compute(const float* logProfile) {
    std::copy_n(logProfile, (mSegments + 1) * 3, mLog.data());
    compute();
}

void TexelEnergy::compute() {
    const int count = mSegments * 3;
    computeValues(mLog.data(), wholeVectors(count + 3), mValue.data());
    computeEnergies(mLog.data(), mValue.data(), mIndex.data(), wholeVectors(count), mEnergy.data());
    addUp();
}

void TexelEnergy::computeFirst() {
    computeValues(mLog.data(), kLanes, mValue.data());
    computeEnergies(mLog.data(), mValue.data(), mIndex.data(), kLanes, mEnergy.data());
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

float TexelEnergy::channelRadius(int channel, float fraction, float blackTotal) const {
    float radius;
    RadiusSearch search;
    addChannelRadius(search, channel, fraction, blackTotal, radius);
    search.finish();
    return radius;
}

void TexelEnergy::addChannelRadius(RadiusSearch& search, int channel, float fraction,
                                   float blackTotal, float& radius) const {
    radius = 0.0f;
    if (mTotal[channel] >= blackTotal) {
        float remaining = mTotal[channel] * fraction;
        const int k = segmentHolding(channel, remaining);
        addSearch(search, k, channel, remaining, radius);
    }
}

float TexelEnergy::within(int channel, float radius) const {
    const int whole = std::clamp(static_cast<int>(radius), 0, mSegments);
    float sum = 0.0f;
    for (int k = 0; k < whole; ++k) {
        sum += ofSegment(k, channel);
    }
    const float t = radius - static_cast<float>(whole);
    if (whole < mSegments && t > 0.0f) {
        const int i = whole * 3 + channel;
        const float z = (mLog[i + 3] - mLog[i]) * t;
        const bool isSmall = std::abs(z) < 0.3f;
        const float m0 = isSmall ? momentSeries0(z) : (fastExp(z) - 1.0f) / z;
        const float m1 = isSmall ? momentSeries1(z) : (fastExp(z) - m0) / z;
        sum += mValue[i] * t * (static_cast<float>(whole) * m0 + t * m1);
    }
    return sum;
}

float TexelEnergy::radiusBound(int channel, float fraction, float blackTotal) const {
    if (mTotal[channel] < blackTotal) {
        return 0.0f;
    }
    float remaining = mTotal[channel] * fraction;
    return static_cast<float>(segmentHolding(channel, remaining) + 1);
}

void TexelEnergy::addRadius(RadiusSearch& search, float fraction, float blackTotal,
                            float& radius) const {
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
    radius = 0.0f;
    for (std::size_t channel = 0; channel < 3 && farthest >= 0; ++channel) {
        if (segment[channel] == farthest) {
            addSearch(search, farthest, static_cast<int>(channel), remaining[channel], radius);
        }
    }
}

void TexelEnergy::addSearch(RadiusSearch& search, int k, int channel, float energy,
                            float& radius) const {
    const int i = k * 3 + channel;
    search.add({static_cast<float>(k), mValue[i], mLog[i + 3] - mLog[i], mEnergy[i], energy},
               radius);
}

} // namespace celadon::subedit
