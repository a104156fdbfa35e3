#pragma once

#include "subedit/map/material_map.h"
#include "subedit/radius_search.h"

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

    /// What is computed from, as compute() copied it, to be changed; room for a whole number of
    /// `kLanes` values. Radii ask for the slopes only: as long as these stay, so do radii.
    [[nodiscard]] float* logProfile() { return mLog.data(); }
    /// As compute(), of what logProfile() holds.
    void compute();
    /// The same bits, where only the first knot is another than it was.
    void computeFirst();

    /// P at the knots, channel fastest, of what was computed last.
    [[nodiscard]] const float* values() const { return mValue.data(); }

    static constexpr int kLanes = 8;
    [[nodiscard]] static constexpr int wholeVectors(int count) {
        return (count + kLanes - 1) / kLanes * kLanes;
    }

    [[nodiscard]] float total(int channel) const {
        return mTotal[static_cast<std::size_t>(channel)];
    }

    [[nodiscard]] float first(int channel) const { ///< of the first segment
        return mEnergy[static_cast<std::size_t>(channel)];
    }

    [[nodiscard]] float last(int channel) const { ///< of the last segment
        return ofSegment(mSegments - 1, channel);
    }

    [[nodiscard]] float ofSegment(int segment, int channel) const {
        return mEnergy[static_cast<std::size_t>(segment * 3 + channel)];
    }

    /// Of a channel from 0 to a radius in units of h.
    [[nodiscard]] float within(int channel, float radius) const;

    /// Diffuse albedo for knots h mm apart.
    [[nodiscard]] float albedo(int channel, float h) const {
        return 2.0f * std::numbers::pi_v<float> * h * h * total(channel);
    }

    /// Radius in units of h that holds `fraction` of one channel; 0 if its total is below
    /// `blackTotal`.
    [[nodiscard]] float channelRadius(int channel, float fraction, float blackTotal) const;

    /// The end of the segment in which channelRadius() lies: at most a segment above it, quicker.
    [[nodiscard]] float radiusBound(int channel, float fraction, float blackTotal) const;

    /// Largest of the channels' radii in units of h; 0 when all are black. It is in `radius` when
    /// the search has finished.
    void addRadius(RadiusSearch& search, float fraction, float blackTotal, float& radius) const;
    /// One channel's.
    void addChannelRadius(RadiusSearch& search, int channel, float fraction, float blackTotal,
                          float& radius) const;

    /// What `blackTotal` is for knots h mm apart.
    [[nodiscard]] static float blackTotal(float h) {
        return kBlackAlbedo / (2.0f * std::numbers::pi_v<float> * h * h);
    }

private:
    void addUp();
    /// The segment in which the energy up to it exceeds `remaining`, which becomes what is left
    /// for that segment.
    [[nodiscard]] int segmentHolding(int channel, float& remaining) const;
    void addSearch(RadiusSearch& search, int k, int channel, float energy, float& radius) const;

    /// Whole vectors are computed, the last one with a knot beyond it.
    static constexpr std::size_t kRoom =
        ((kMaxSegments + 1) * 3 + kLanes - 1) / kLanes * kLanes + kLanes;

    int mSegments;
    // Of these only what the segments need is ever set.
    std::array<float, kRoom> mIndex;
    std::array<float, kRoom> mLog; ///< ln P
    std::array<float, kRoom> mValue;
    std::array<float, kRoom> mEnergy;
    std::array<float, 3> mTotal{};
};

} // namespace celadon::subedit
