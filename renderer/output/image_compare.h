#pragma once

#include "renderer/output/image.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Numbers for the difference between two pictures of equal shape: errors of values, PSNR, and
/// how they look (ssim.h, flip.h). A is the picture judged, B the reference.
namespace celadon {

struct NonFinite {
    std::size_t count = 0; ///< NaN and infinite values
    int x = 0, y = 0;      ///< of the first one
    std::string channel;
};
/// Unset when every value is finite.
[[nodiscard]] std::optional<NonFinite> findNonFinite(const FloatImage& image);

/// Errors over all values of all channels, e = |a - b|.
struct ValueErrors {
    double rmse = 0.0;         ///< sqrt(mean(e^2))
    double relativeRmse = 0.0; ///< rmse / sqrt(mean(b^2)); 0 where both are 0, else infinite
    double psnr = 0.0;         ///< 20 log10(peak / rmse) dB; infinite for equal pictures
    double peak = 1.0;         ///< the largest of 1, |a| and |b|: 1 for display values
    double meanRatio = 1.0;    ///< mean(a) / mean(b); 1 where both are 0, else infinite
    double mean = 0.0;         ///< mean(e)
    double max = 0.0;
    double p50 = 0.0, p95 = 0.0, p99 = 0.0; ///< e that this percentage of values stays within
};

/// Both of one shape (a programmer mistake otherwise) and finite. Symmetric apart from
/// relativeRmse and meanRatio, exactly 0 for equal pictures.
[[nodiscard]] ValueErrors compareValues(const FloatImage& a, const FloatImage& b);

/// Smallest value that at least `percent` of the values stay within (nearest rank).
[[nodiscard]] float percentile(std::vector<float> values, double percent);

/// The channels of one layer: "" gives R,G,B (or Y), "exitance" gives exitance.R,G,B, "radius" the
/// channel of that name; alpha is never among them. Channel names lose the layer's prefix.
/// Empty when there is no such layer.
[[nodiscard]] FloatImage extractLayer(const FloatImage& image, const std::string& layer);

/// |a - b|, the largest of all channels, one channel "error".
[[nodiscard]] FloatImage errorMap(const FloatImage& a, const FloatImage& b);

/// Colors for a picture of one channel: 0 is black, `largest` nearly white, dark violet over red
/// to yellow between, of evenly rising lightness. @return display-encoded R,G,B
[[nodiscard]] FloatImage heatMap(const FloatImage& values, float largest);

} // namespace celadon
