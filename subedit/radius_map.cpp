#include "subedit/radius_map.h"

#include "subedit/assert.h"
#include "subedit/fast_exp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace celadon::subedit {

namespace {

constexpr float kBlackAlbedo = 1e-6f; ///< as in effective_radius.cpp

/// Energies of one texel's segments in units of h^2: integral of P r dr = h^2 energy.
class TexelEnergy {
public:
    explicit TexelEnergy(int segments) : mSegments(segments) {
        for (int i = 0; i < segments * 3; ++i) {
            mIndex[i] = static_cast<float>(i / 3);
        }
    }

    void compute(const float* logProfile) {
        const int count = mSegments * 3;
        for (int i = 0; i < count + 3; ++i) {
            mValue[i] = fastExp(logProfile[i]);
        }
        // log_linear.h with t = 1, both branches computed so that the loop vectorizes.
        for (int i = 0; i < count; ++i) {
            const float z = logProfile[i + 3] - logProfile[i];
            const float p0 = mValue[i];
            const float p1 = mValue[i + 3];
            const bool isSmall = std::abs(z) < 0.3f;
            const float inverse = 1.0f / (isSmall ? 1.0f : z);
            const float m0 = (p1 - p0) * inverse;
            const float m1 = (p1 - m0) * inverse;
            const float s0 =
                p0 * (1.0f + z * (1.0f / 2 + z * (1.0f / 6 + z * (1.0f / 24 + z / 120))));
            const float s1 =
                p0 * (1.0f / 2 + z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z / 144))));
            mEnergy[i] = mIndex[i] * (isSmall ? s0 : m0) + (isSmall ? s1 : m1);
        }
        mTotal = {};
        for (int i = 0; i < count; i += 3) {
            mTotal[0] += mEnergy[i];
            mTotal[1] += mEnergy[i + 1];
            mTotal[2] += mEnergy[i + 2];
        }
    }

    [[nodiscard]] float total(int channel) const { return mTotal[channel]; }

    /// Largest of the channels' radii in units of h; 0 when all are black.
    [[nodiscard]] float radius(const float* logProfile, float fraction, float blackTotal) const {
        float largest = 0.0f;
        for (int channel = 0; channel < 3; ++channel) {
            if (mTotal[channel] < blackTotal) {
                continue;
            }
            float remaining = mTotal[channel] * fraction;
            int k = 0;
            while (k < mSegments - 1 && remaining > mEnergy[k * 3 + channel]) {
                remaining -= mEnergy[k * 3 + channel];
                ++k;
            }
            if (static_cast<float>(k + 1) > largest) { // else another channel reaches farther
                largest = std::max(largest, static_cast<float>(k) +
                                                invert(logProfile, k, channel, remaining));
            }
        }
        return largest;
    }

private:
    /// Newton from the point where the energy would be with P constant, inside a bracket.
    [[nodiscard]] float invert(const float* logProfile, int k, int channel, float energy) const {
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
                m0 = p0 * (1.0f + z * (1.0f / 2 + z * (1.0f / 6 + z * (1.0f / 24 + z / 120))));
                m1 = p0 * (1.0f / 2 + z * (1.0f / 3 + z * (1.0f / 8 + z * (1.0f / 30 + z / 144))));
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

    int mSegments;
    std::array<float, (kMaxSegments + 1) * 3> mIndex;
    std::array<float, (kMaxSegments + 1) * 3> mValue;
    std::array<float, (kMaxSegments + 1) * 3> mEnergy;
    std::array<float, 3> mTotal{};
};

/// Calls work(texel index, its energies) for all texels, on all cores.
template<typename Work>
void forEachTexel(const MaterialMap& map, const Work& work) {
    const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    const auto stride = static_cast<std::size_t>(map.knots()) * 3;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels, 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          TexelEnergy energy(map.segments);
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              const float* logProfile = map.logProfile.data() + i * stride;
                              energy.compute(logProfile);
                              work(i, logProfile, energy);
                          }
                      });
}

} // namespace

std::vector<std::vector<float>> effectiveRadiusMaps(const MaterialMap& map,
                                                    std::span<const double> energyFractions) {
    CELADON_ASSERT(map.segments >= 1 && map.segments <= kMaxSegments);
    const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    std::vector<std::vector<float>> radii(energyFractions.size(), std::vector<float>(texels));
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const float blackTotal = kBlackAlbedo / (2.0f * std::numbers::pi_v<float> * h * h);
    const float smallest = map.maxRadiusMm * 1e-3f;
    forEachTexel(map, [&](std::size_t i, const float* logProfile, const TexelEnergy& energy) {
        for (std::size_t e = 0; e < radii.size(); ++e) {
            const auto fraction = static_cast<float>(energyFractions[e]);
            const float radius = fraction >= 1.0f
                                     ? map.maxRadiusMm
                                     : h * energy.radius(logProfile, fraction, blackTotal);
            radii[e][i] = std::clamp(radius, smallest, map.maxRadiusMm);
        }
    });
    return radii;
}

std::vector<float> effectiveRadiusMap(const MaterialMap& map, double energyFraction) {
    return std::move(effectiveRadiusMaps(map, {&energyFraction, 1}).front());
}

std::vector<float> albedoMap(const MaterialMap& map) {
    const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    std::vector<float> albedo(texels * 3);
    const float h = map.maxRadiusMm / static_cast<float>(map.segments);
    const float scale = 2.0f * std::numbers::pi_v<float> * h * h;
    forEachTexel(map, [&](std::size_t i, const float*, const TexelEnergy& energy) {
        for (int channel = 0; channel < 3; ++channel) {
            albedo[i * 3 + static_cast<std::size_t>(channel)] = scale * energy.total(channel);
        }
    });
    return albedo;
}

} // namespace celadon::subedit
