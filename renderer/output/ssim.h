#pragma once

#include "renderer/output/image.h"

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment").
namespace celadon {

/// Mean over channels and pixels of eq. 13 with the paper's constants: 11x11 Gaussian window of
/// standard deviation 1.5, K1 = 0.01, K2 = 0.03, dynamic range 1. As in the paper's program only
/// windows that lie inside the picture count; in a picture smaller than a window, all do, with the
/// border repeated.
/// @param a,b of one shape, display-encoded, in [0, 1]
/// @return at most 1, which equal pictures get exactly; symmetric
[[nodiscard]] double structuralSimilarity(const FloatImage& a, const FloatImage& b);

} // namespace celadon
