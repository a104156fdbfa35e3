#pragma once

#include "renderer/output/image.h"

/// Flicker: how a picture changes from one frame to the next beyond what its truth changes. An
/// error that stands still does not count, an error that moves does: the measure for a light that
/// turns, a camera that travels, a shape that bends slowly.
namespace celadon {

/// Two frames of one sequence, of one shape.
struct FramePair {
    const FloatImage& before;
    const FloatImage& after;
};

/// With J of the pictures judged, T of truth: both numbers are root mean squares over all values,
/// relative to that of the two pictures of truth. 0 where those are black, unless what is divided
/// is not: then infinite.
struct Flicker {
    double trueChange = 0.0;  ///< T_after - T_before
    double beyondTruth = 0.0; ///< (J_after - J_before) - (T_after - T_before)
};

/// All four of one shape (a programmer mistake otherwise) and finite: layer "exitance" of what
/// --aov writes, say. Exactly 0 beyond truth where both pairs differ by a constant picture.
[[nodiscard]] Flicker measureFlicker(const FramePair& judged, const FramePair& truth);

/// |(J_after - J_before) - (T_after - T_before)|, the largest of all channels, one channel "error".
[[nodiscard]] FloatImage flickerMap(const FramePair& judged, const FramePair& truth);

} // namespace celadon
