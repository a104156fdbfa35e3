#pragma once

#include "renderer/output/image.h"

/// FLIP: how different two pictures look when one is flipped for the other in place (Andersson,
/// Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A Difference Evaluator for
/// Alternating Images"); for high dynamic range Andersson, Nilsson, Shirley, Akenine-Moeller 2021,
/// "Visualizing Errors in Rendered High Dynamic Range Images". Written from the papers.
namespace celadon {

/// 0.7 m from a screen of 0.7 m with 3840 pixels, the paper's setting (2020, section 6).
inline constexpr double kDefaultPixelsPerDegree = 67.020643276;

/// @param a,b of one size, channels R,G,B, linear; values outside [0, 1] are clamped
/// @return one channel "flip" in [0, 1]: 0 for equal pixels in equal surroundings. Symmetric.
///         The headline is its mean.
[[nodiscard]] FloatImage flipMap(const FloatImage& a, const FloatImage& b,
                                 double pixelsPerDegree = kDefaultPixelsPerDegree);

/// The largest FLIP over exposures at which the reference's bright and median parts are well
/// exposed, tone mapped by Narkowicz's ACES curve (2021, sections 3 and 4). The median is taken
/// over pixels that are not black: a picture of an object is mostly background.
/// @param test,reference of one size, channels R,G,B, linear radiance. Not symmetric.
[[nodiscard]] FloatImage hdrFlipMap(const FloatImage& test, const FloatImage& reference,
                                    double pixelsPerDegree = kDefaultPixelsPerDegree);

/// The mean of a picture's values.
[[nodiscard]] double meanValue(const FloatImage& image);

} // namespace celadon
