#pragma once

#include "subedit/mean_profile.h"

#include <array>
#include <span>

/// The minimal effective rendering radius R(T) (Chen et al. 2012, eqs. 13 and 14; DESIGN 3.3): how
/// near to a sample, in units of its R_P, a buffer on which R_P covers T pixels may be used.
namespace celadon::subedit {

inline constexpr int kRangeTableEntriesPerOctave = 8;
inline constexpr int kRangeTableMaxLog2 = 12;
inline constexpr int kRangeTableEntries = kRangeTableEntriesPerOctave * kRangeTableMaxLog2 + 1;

/// Values over log2 T = 0 ... 12, equally spaced.
class RangeTable {
public:
    /// @param epsilon error allowed in the energy between any radius >= R(T) and 1, of 1 in all
    [[nodiscard]] static RangeTable build(const MeanProfile& profile, double epsilon);

    /// From a table made before. @param T > 0, rising; @param radius R(T) in [0, 1], as many, >= 1
    /// Interpolated over log2 T; beyond the samples, the first and the last.
    [[nodiscard]] static RangeTable fromSamples(std::span<const double> T,
                                                std::span<const double> radius);

    /// R(T) in [0, 1], interpolated over log2 T; 1 for T <= 1, the last entry beyond 4096.
    [[nodiscard]] float minimalRadius(float pixelsPerRadius) const;

    /// Entry i is R(2^(i / kRangeTableEntriesPerOctave)).
    [[nodiscard]] std::span<const float> values() const { return mValues; }

private:
    std::array<float, kRangeTableEntries> mValues{};
};

/// The quantity that eq. 14 bounds: |(1/T) sum P(r) r over r = r', r' + 1/T, ... <= 1
/// - integral of P r dr over [r', 1]|.
[[nodiscard]] double samplingError(const MeanProfile& profile, double T, double rPrime);

/// R(T): the smallest r such that samplingError < epsilon for every r' in [r, 1 - 1/T]. Where even
/// r' = 1 - 1/T fails, or T <= 1, no sampling at this rate is good enough, and the result is 1:
/// eq. 14, read to the letter, would there be satisfied by the empty interval and return 1 - 1/T.
[[nodiscard]] double minimalRadius(const MeanProfile& profile, double T, double epsilon);

} // namespace celadon::subedit
