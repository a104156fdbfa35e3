#pragma once

#include "subedit/paint/brush.h"
#include "subedit/paint/surface.h"
#include "subedit/select/weight_mask.h"

#include <cstdint>
#include <vector>

/// A picture laid onto the surface, as a decal: how much of an edit each texel gets.
namespace celadon::subedit {

inline constexpr int kLargestStamp = 512; ///< pixels on a side

struct Stamp {
    StrokePoint at;            ///< where the picture's middle lies; pressure scales it all
    float widthMm = 10.0f;     ///< of the picture on the tangent plane, > 0
    float angleDegrees = 0.0f; ///< counter-clockwise, seen from outside; 0: its top is upwards (+y)
    int width = 0;             ///< pixels, 1 to kLargestStamp
    int height = 0;
    std::vector<std::uint8_t> weights; ///< [height][width], top row first; 255: all of the edit
    Mirror mirror;                     ///< on these sides its mirror image as well
    bool operator==(const Stamp&) const = default;
};

/// The picture is projected along the normal at its middle, filtered bilinearly, onto the part of
/// the surface that a dab of the picture's size would reach: not through thin parts, fading where
/// the surface turns away.
/// @return all zero if the surface is not near
[[nodiscard]] WeightMask stampMask(const Surface& surface, const Stamp& stamp);

} // namespace celadon::subedit
