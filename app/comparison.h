#pragma once

#include "renderer/output/image.h"
#include "renderer/output/image_compare.h"
#include "renderer/output/tone_map.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Two picture files against each other: what `celadon compare` computes.
namespace celadon::app {

enum class Metric {
    Rmse,
    RelativeRmse,
    Psnr,
    Ssim,
    Flip,
    FlipHdr,
    MeanRatio,
    Mean,
    Max,
    P50,
    P95,
    P99,
    AlphaRmse
};

/// As in JSON: "relativeRmse".
[[nodiscard]] const char* metricName(Metric metric);
/// As a user writes them, in one line: "rmse, relative-rmse, ...".
[[nodiscard]] std::string metricWords();
/// Any case, with or without '-' and '_': "relative-rmse". @throws UsageError listing all
[[nodiscard]] Metric parseMetric(std::string_view word);
/// All but the slow flipHdr.
[[nodiscard]] std::vector<Metric> usualMetrics();
[[nodiscard]] std::span<const Metric> allMetrics();

struct ComparisonSettings {
    std::string layer; ///< "" is the picture's color, "exitance" the layer of that name
    /// How linear pictures are shown to ssim and flip; files that are display-encoded are shown as
    /// they are.
    double exposureEv = 0.0;
    ToneMap toneMap = ToneMap::Neutral;
};

/// Metrics are computed when asked for.
///
/// Values (rmse, relativeRmse, psnr, meanRatio, mean, max, percentiles) are compared as stored:
/// display-encoded when both files are, else linear, premultiplied. ssim, flip look at what a
/// display shows; flipHdr at linear values.
class Comparison {
public:
    /// @throws InputError: unreadable; different sizes or channels; NaN or infinite pixels
    Comparison(const std::filesystem::path& a, const std::filesystem::path& b,
               const ComparisonSettings& settings);

    [[nodiscard]] int width() const { return mA.values.width; }
    [[nodiscard]] int height() const { return mA.values.height; }
    [[nodiscard]] bool displayEncoded() const { return mDisplayEncoded; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return mWarnings; }

    /// ssim, flip and flipHdr need color, alphaRmse an alpha in one of the files.
    [[nodiscard]] bool has(Metric metric) const;

    /// May be infinite. @throws InputError when !has(metric)
    [[nodiscard]] double value(Metric metric);

    /// flip where the layer is a color, else |a - b| scaled to its largest: display-encoded R,G,B.
    [[nodiscard]] FloatImage heatMap();

private:
    struct Side {
        FloatImage values; ///< of the layer, in the domain in which values are compared
        FloatImage linear; ///< the same, linear R,G,B; empty where the layer is no color
        FloatImage shown;  ///< display light in [0, 1], linear; empty likewise
        std::optional<FloatImage> alpha;
    };

    const FloatImage& flip();

    Side mA, mB;
    bool mDisplayEncoded = false;
    std::string mLayer;
    std::vector<std::string> mWarnings;
    std::optional<ValueErrors> mErrors;
    std::optional<FloatImage> mFlip;
};

} // namespace celadon::app
