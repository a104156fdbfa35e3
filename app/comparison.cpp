#include "app/comparison.h"

#include "renderer/output/flip.h"
#include "renderer/output/image_io.h"
#include "renderer/output/ssim.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace celadon::app {
namespace fs = std::filesystem;
namespace {

struct MetricEntry {
    Metric metric;
    const char* name;
};
constexpr std::array<MetricEntry, 13> kMetrics = {{{Metric::Rmse, "rmse"},
                                                   {Metric::RelativeRmse, "relativeRmse"},
                                                   {Metric::Psnr, "psnr"},
                                                   {Metric::Ssim, "ssim"},
                                                   {Metric::Flip, "flip"},
                                                   {Metric::FlipHdr, "flipHdr"},
                                                   {Metric::MeanRatio, "meanRatio"},
                                                   {Metric::Mean, "mean"},
                                                   {Metric::Max, "max"},
                                                   {Metric::P50, "p50"},
                                                   {Metric::P95, "p95"},
                                                   {Metric::P99, "p99"},
                                                   {Metric::AlphaRmse, "alphaRmse"}}};

std::string plain(std::string_view word) {
    std::string result;
    for (const unsigned char c : word) {
        if (c != '-' && c != '_') {
            result += static_cast<char>(std::tolower(c));
        }
    }
    return result;
}

std::string quote(const fs::path& path) {
    return fmt::format("'{}'", path.string());
}

void refuseNonFinite(const fs::path& file, const FloatImage& image) {
    if (const std::optional<NonFinite> bad = findNonFinite(image)) {
        throw InputError(
            quote(file),
            fmt::format("{} values are NaN or infinite, the first in channel {} at pixel {},{}",
                        bad->count, bad->channel, bad->x, bad->y),
            "such pictures cannot be compared");
    }
}

FloatImage layerOf(const fs::path& file, const FloatImage& image, const std::string& layer) {
    FloatImage result = extractLayer(image, layer);
    if (result.channels.empty()) {
        throw InputError(quote(file),
                         layer.empty() ? std::string("has no color (R,G,B or Y)")
                                       : fmt::format("has no layer '{}'", layer),
                         fmt::format("its channels are {}", fmt::join(image.channels, ", ")));
    }
    refuseNonFinite(file, result);
    return result;
}

/// Three equal channels for a gray picture; empty for what is no color.
FloatImage asColor(const FloatImage& layer) {
    if (layer.channels == std::vector<std::string>{"R", "G", "B"}) {
        return layer;
    }
    if (layer.channels != std::vector<std::string>{"Y"}) {
        return {};
    }
    FloatImage result = layer;
    result.channels = {"R", "G", "B"};
    result.pixels.clear();
    for (const float value : layer.pixels) {
        result.pixels.insert(result.pixels.end(), 3, value);
    }
    return result;
}

FloatImage mapped(FloatImage image, float (*function)(float)) {
    std::transform(image.pixels.begin(), image.pixels.end(), image.pixels.begin(), function);
    return image;
}

std::optional<FloatImage> alphaOf(const fs::path& file, const FloatImage& image) {
    FloatImage alpha = extractLayer(image, "A");
    if (alpha.channels.empty()) {
        return std::nullopt;
    }
    refuseNonFinite(file, alpha);
    return alpha;
}

} // namespace

const char* metricName(Metric metric) {
    return std::find_if(kMetrics.begin(), kMetrics.end(),
                        [&](const MetricEntry& entry) { return entry.metric == metric; })
        ->name;
}

std::string metricWords() {
    std::string words;
    for (const MetricEntry& entry : kMetrics) {
        words += words.empty() ? "" : ", ";
        for (const char c : std::string_view(entry.name)) {
            const bool isCapital = c >= 'A' && c <= 'Z';
            words += isCapital ? fmt::format("-{}", static_cast<char>(c - 'A' + 'a'))
                               : std::string(1, c);
        }
    }
    return words;
}

Metric parseMetric(std::string_view word) {
    for (const MetricEntry& entry : kMetrics) {
        if (plain(entry.name) == plain(word)) {
            return entry.metric;
        }
    }
    throw UsageError(fmt::format("'{}'", word), "is no metric",
                     fmt::format("choose {}", metricWords()));
}

std::span<const Metric> allMetrics() {
    static const std::vector<Metric> all = [] {
        std::vector<Metric> list;
        for (const MetricEntry& entry : kMetrics) {
            list.push_back(entry.metric);
        }
        return list;
    }();
    return all;
}

std::vector<Metric> usualMetrics() {
    std::vector<Metric> list(allMetrics().begin(), allMetrics().end());
    std::erase(list, Metric::FlipHdr);
    return list;
}

Comparison::Comparison(const fs::path& fileA, const fs::path& fileB,
                       const ComparisonSettings& settings)
    : mLayer(settings.layer) {
    const ReadImage a = readImage(fileA);
    const ReadImage b = readImage(fileB);
    if (a.image.width != b.image.width || a.image.height != b.image.height) {
        throw InputError(fmt::format("{} and {}", quote(fileA), quote(fileB)),
                         fmt::format("sizes differ, {}x{} and {}x{}", a.image.width, a.image.height,
                                     b.image.width, b.image.height));
    }
    mDisplayEncoded = settings.layer.empty() && a.displayEncoded && b.displayEncoded;

    const auto prepare = [&](const fs::path& file, const ReadImage& read) {
        Side side;
        side.values = layerOf(file, read.image, settings.layer);
        side.linear = asColor(side.values);
        side.shown = read.displayEncoded ? side.linear
                                         : toDisplayLight(side.linear, settings.toneMap,
                                                          static_cast<float>(settings.exposureEv));
        if (mDisplayEncoded) {
            side.values = mapped(std::move(side.values), encodeSrgb);
        }
        if (settings.layer.empty()) {
            side.alpha = alphaOf(file, read.image);
        }
        return side;
    };
    mA = prepare(fileA, a);
    mB = prepare(fileB, b);
    if (mA.values.channels != mB.values.channels) {
        throw InputError(fmt::format("{} and {}", quote(fileA), quote(fileB)),
                         fmt::format("channels differ, {} and {}",
                                     fmt::join(mA.values.channels, ","),
                                     fmt::join(mB.values.channels, ",")));
    }
    if (mA.alpha.has_value() != mB.alpha.has_value()) {
        mWarnings.push_back(fmt::format("only {} has an alpha channel; the other counts as opaque",
                                        quote(mA.alpha ? fileA : fileB)));
        FloatImage opaque = mA.alpha ? *mA.alpha : *mB.alpha;
        std::fill(opaque.pixels.begin(), opaque.pixels.end(), 1.0f);
        (mA.alpha ? mB.alpha : mA.alpha) = std::move(opaque);
    }
}

bool Comparison::has(Metric metric) const {
    switch (metric) {
    case Metric::Ssim:
    case Metric::Flip:
    case Metric::FlipHdr:
        return !mA.linear.channels.empty();
    case Metric::AlphaRmse:
        return mA.alpha.has_value();
    default:
        return true;
    }
}

const FloatImage& Comparison::flip() {
    if (!mFlip) {
        mFlip = flipMap(mA.shown, mB.shown);
    }
    return *mFlip;
}

double Comparison::value(Metric metric) {
    if (!has(metric)) {
        throw InputError(metricName(metric),
                         metric == Metric::AlphaRmse
                             ? std::string("the pictures have no alpha channel")
                             : fmt::format("layer '{}' is no color", mLayer),
                         "choose another metric");
    }
    if (!mErrors) {
        mErrors = compareValues(mA.values, mB.values);
    }
    switch (metric) {
    case Metric::Rmse:
        return mErrors->rmse;
    case Metric::RelativeRmse:
        return mErrors->relativeRmse;
    case Metric::Psnr:
        return mErrors->psnr;
    case Metric::Ssim:
        return structuralSimilarity(mapped(mA.shown, encodeSrgb), mapped(mB.shown, encodeSrgb));
    case Metric::Flip:
        return meanValue(flip());
    case Metric::FlipHdr:
        return meanValue(hdrFlipMap(mA.linear, mB.linear));
    case Metric::MeanRatio:
        return mErrors->meanRatio;
    case Metric::Mean:
        return mErrors->mean;
    case Metric::Max:
        return mErrors->max;
    case Metric::P50:
        return mErrors->p50;
    case Metric::P95:
        return mErrors->p95;
    case Metric::P99:
        return mErrors->p99;
    case Metric::AlphaRmse:
        break;
    }
    return compareValues(*mA.alpha, *mB.alpha).rmse;
}

FloatImage Comparison::heatMap() {
    if (has(Metric::Flip)) {
        return celadon::heatMap(flip(), 1.0f);
    }
    const FloatImage errors = errorMap(mA.values, mB.values);
    return celadon::heatMap(errors, *std::max_element(errors.pixels.begin(), errors.pixels.end()));
}

} // namespace celadon::app
