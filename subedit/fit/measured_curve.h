#pragma once

#include "subedit/radial_curve.h"

#include <filesystem>
#include <string_view>
#include <vector>

/// A profile given as samples: measured, or computed by another program.
namespace celadon::subedit {

struct MeasuredProfile {
    std::vector<double> radiiMm;              ///< at least 2, strictly rising, >= 0
    std::vector<std::array<double, 3>> value; ///< P in 1/mm^2, >= 0, as many
};

/// What lies between the first sample and r = 0.
enum class CurveCenter {
    Auto,    ///< P = a r^(c-1) e^(-b r) through the first three samples, -0.2 <= c <= 1: from
             ///< profiles that are flat there to those like 1/r and a little steeper
    Flat,    ///< as high as the first sample
    Singular ///< 1/r
};

/// Text of rows `r_mm,R,G,B` or `r_mm,P` (all channels alike); further columns are left out. A
/// header row is optional, empty rows and those that begin with # are skipped.
/// @param name for messages: the file
/// @throws InputError naming the line and the reason: no rows, too few columns, not a number, not
///         finite, negative, radii that do not rise
[[nodiscard]] MeasuredProfile parseProfileCsv(std::string_view text, const std::string& name);

/// @throws InputError as above, or if the file cannot be read
[[nodiscard]] MeasuredProfile readProfileCsv(const std::filesystem::path& file);

/// Between samples ln P is linear in r where P(0) is given; else ln(r P) is, which suits peaks like
/// 1/r and exponential tails alike. Beyond the last sample P is 0.
[[nodiscard]] RadialCurves measuredCurves(const MeasuredProfile& profile,
                                          CurveCenter center = CurveCenter::Auto);

} // namespace celadon::subedit
