#pragma once

#include "subedit/map/material_map.h"

#include <array>
#include <numbers>

/// Energies of one stored profile in single precision and vector code: what maps of radii and
/// albedos, and every edit that must keep or bound the energy, need of each texel. The closed forms
/// in double precision are in effective_radius.h.
namespace celadon::subedit {

inline constexpr float kBlackAlbedo = 1e-6f; ///< a channel below scatters nothing

/// Energies of one texel's segments in units of h^2, h = r_s / n: integral of P r dr = h^2 energy.
/// Not small (some 9 kB): make one per thread and use it for many texels.
class TexelEnergy {
public:
    /// @param segments 1..kMaxSegments
    explicit TexelEnergy(int segments);

    /// @param logProfile (segments + 1) x 3 values of ln P, channel fastest
    void compute(const float* logProfile);
    /// The same bits, where only the first knot is another than it was.
    void computeFirst(const float* logProfile);

    [[nodiscard]] float total(int channel) const {
        return mTotal[static_cast<std::size_t>(channel)];
    }

    [[nodiscard]] float first(int channel) const { ///< of the first segment
        return mEnergy[static_cast<std::size_t>(channel)];
    }

    [[nodiscard]] float last(int channel) const { ///< of the last segment
        return mEnergy[static_cast<std::size_t>((mSegments - 1) * 3 + channel)];
    }

    /// Diffuse albedo for knots h mm apart.
    [[nodiscard]] float albedo(int channel, float h) const {
        return 2.0f * std::numbers::pi_v<float> * h * h * total(channel);
    }

    /// Radius in units of h that holds `fraction` of one channel; 0 if its total is below
    /// `blackTotal`.
    /// @param logProfile that of compute()
    [[nodiscard]] float channelRadius(const float* logProfile, int channel, float fraction,
                                      float blackTotal) const;

    /// The end of the segment in which channelRadius() lies: at most a segment above it, quicker.
    [[nodiscard]] float radiusBound(int channel, float fraction, float blackTotal) const;

    /// Largest of the channels' radii in units of h; 0 when all are black.
    [[nodiscard]] float radius(const float* logProfile, float fraction, float blackTotal) const;

    /// What `blackTotal` is for knots h mm apart.
    [[nodiscard]] static float blackTotal(float h) {
        return kBlackAlbedo / (2.0f * std::numbers::pi_v<float> * h * h);
    }

private:
    void addUp();
    /// The segment in which the energy up to it exceeds `remaining`, which becomes what is left
    /// for that segment.
    [[nodiscard]] int segmentHolding(int channel, float& remaining) const;
    [[nodiscard]] float invert(const float* logProfile, int k, int channel, float energy) const;

    int mSegments;
    std::array<float, (kMaxSegments + 1) * 3> mIndex;
    std::array<float, (kMaxSegments + 1) * 3> mValue;
    std::array<float, (kMaxSegments + 1) * 3> mEnergy;
    std::array<float, 3> mTotal{};
};

} // namespace celadon::subedit
