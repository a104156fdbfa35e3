#pragma once

#include "subedit/texel_energy.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// Rounding of profiles to half precision that keeps their diffuse albedo.
namespace celadon::subedit {

/// Rounds the knots of texels to halves. Half precision has steps of 0.4 % to 1.6 % in P; each knot
/// rounded alone would bend the albedo by as much. A common shift smaller than a step would be lost
/// in the rounding again, so instead single knots are rounded the other way, or a few steps further
/// where there are few, until the energy is kept: to 1e-3 for n >= 8, for fewer to 3e-3; and an
/// albedo of at most 1 stays at most 1. Of one thread, for many texels.
class HalfRounding {
public:
    /// @param segments  1..kMaxSegments
    /// @param segmentMm h = r_s / n
    HalfRounding(int segments, float segmentMm);

    /// @param logProfile (segments + 1) x 3 values of ln P, channel fastest, within [-30, 40]
    /// @param halves     as many bit patterns of IEEE half precision
    void round(const float* logProfile, std::uint16_t* halves);

private:
    struct Knot {
        float value = 0.0f;   ///< as it is
        float rounded = 0.0f; ///< as it will be
        float other = 0.0f;   ///< the half on the other side of the value
        float weight = 0.0f;  ///< change of energy per change of ln P, times 3 / h^2
    };
    using Channel = std::vector<Knot>;
    /// What an error of the energy is to be, times 3 / h^2.
    struct Goal {
        float target = 0.0f;
        float highest = std::numeric_limits<float>::max(); ///< above it all is worse than below
        [[nodiscard]] float miss(float error) const {
            return std::abs(error - target) + (error > highest ? 1e30f : 0.0f);
        }
    };

    static float layOut(const float* logProfile, int channel, Channel& knots);
    static float flip(Channel& knots, float error, const Goal& goal);
    static float search(Channel& knots, float error, const Goal& goal, int mostSteps);
    void correct(int channel, float totalBefore);
    void place(int channel);

    float mAlbedoPerTotal;
    TexelEnergy mEnergy;
    std::array<Channel, 3> mChannels;
    std::vector<float> mRounded; ///< of all channels, as a profile
};

} // namespace celadon::subedit
