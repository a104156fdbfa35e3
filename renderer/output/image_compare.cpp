#include "renderer/output/image_compare.h"

#include "subedit/assert.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace celadon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// a / b where 0 / 0 is `both`.
double ratio(double a, double b, double both) {
    if (b == 0.0) {
        return a == 0.0 ? both : kInfinity;
    }
    return a / b;
}

[[maybe_unused]] bool sameShape(const FloatImage& a, const FloatImage& b) {
    return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

} // namespace

std::optional<NonFinite> findNonFinite(const FloatImage& image) {
    NonFinite found;
    std::size_t first = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (!std::isfinite(image.pixels[i]) && found.count++ == 0) {
            first = i;
        }
    }
    if (found.count == 0) {
        return std::nullopt;
    }
    const std::size_t pixel = first / image.channelCount();
    found.x = static_cast<int>(pixel % static_cast<std::size_t>(image.width));
    found.y = static_cast<int>(pixel / static_cast<std::size_t>(image.width));
    found.channel = image.channels[first % image.channelCount()];
    return found;
}

float percentile(std::vector<float> values, double percent) {
    if (values.empty()) {
        return 0.0f;
    }
    const double rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()));
    const std::size_t index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
    const auto nth =
        values.begin() + static_cast<std::ptrdiff_t>(std::min(index, values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

ValueErrors compareValues(const FloatImage& a, const FloatImage& b) {
    CELADON_ASSERT(sameShape(a, b) && !a.pixels.empty());
    std::vector<float> errors(a.pixels.size());
    double squares = 0.0;
    double referenceSquares = 0.0;
    double sumA = 0.0;
    double sumB = 0.0;
    double sumErrors = 0.0;
    ValueErrors result;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double valueA = a.pixels[i];
        const double valueB = b.pixels[i];
        const double error = std::abs(valueA - valueB);
        errors[i] = static_cast<float>(error);
        squares += error * error;
        referenceSquares += valueB * valueB;
        sumA += valueA;
        sumB += valueB;
        sumErrors += error;
        result.max = std::max(result.max, error);
        result.peak = std::max({result.peak, std::abs(valueA), std::abs(valueB)});
    }
    const double count = static_cast<double>(errors.size());
    result.rmse = std::sqrt(squares / count);
    result.relativeRmse = ratio(result.rmse, std::sqrt(referenceSquares / count), 0.0);
    result.psnr = result.rmse == 0.0 ? kInfinity : 20.0 * std::log10(result.peak / result.rmse);
    result.meanRatio = ratio(sumA, sumB, 1.0);
    result.mean = sumErrors / count;
    result.p50 = percentile(errors, 50.0);
    result.p95 = percentile(errors, 95.0);
    result.p99 = percentile(std::move(errors), 99.0);
    return result;
}

FloatImage extractLayer(const FloatImage& image, const std::string& layer) {
    FloatImage result;
    result.width = image.width;
    result.height = image.height;
    std::vector<std::size_t> sources;
    const auto take = [&](std::size_t index, const std::string& name) {
        sources.push_back(index);
        result.channels.push_back(name);
    };
    const std::string prefix = layer + ".";
    for (std::size_t c = 0; c < image.channelCount(); ++c) {
        const std::string& name = image.channels[c];
        if (layer.empty()) {
            if (name == "R" || name == "G" || name == "B" || name == "Y") {
                take(c, name);
            }
        } else if (name == layer) {
            take(c, name);
        } else if (name.starts_with(prefix) && name != prefix + "A") {
            take(c, name.substr(prefix.size()));
        }
    }
    if (sources.empty()) {
        return {};
    }
    // One order whatever the file's: EXR sorts by name, and B,G,R would be odd to meet.
    const std::vector<std::string> wanted{"R", "G", "B"};
    if (result.channels.size() == 3 &&
        std::is_permutation(wanted.begin(), wanted.end(), result.channels.begin())) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = i; j < 3; ++j) {
                if (result.channels[j] == wanted[i]) {
                    std::swap(result.channels[i], result.channels[j]);
                    std::swap(sources[i], sources[j]);
                }
            }
        }
    }
    const std::size_t pixels = image.pixels.size() / image.channelCount();
    result.pixels.reserve(pixels * sources.size());
    for (std::size_t i = 0; i < pixels; ++i) {
        for (const std::size_t source : sources) {
            result.pixels.push_back(image.pixels[i * image.channelCount() + source]);
        }
    }
    return result;
}

FloatImage errorMap(const FloatImage& a, const FloatImage& b) {
    CELADON_ASSERT(sameShape(a, b));
    FloatImage result;
    result.width = a.width;
    result.height = a.height;
    result.channels = {"error"};
    const std::size_t stride = a.channelCount();
    result.pixels.assign(stride == 0 ? 0 : a.pixels.size() / stride, 0.0f);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        float& largest = result.pixels[i / stride];
        largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
    }
    return result;
}

FloatImage heatMap(const FloatImage& values, float largest) {
    CELADON_ASSERT(values.channelCount() == 1);
    // Lightness rises by about equal steps (L* = 0, 14, 28, 43, 58, 74, 97).
    constexpr std::array<glm::vec3, 7> kStops = {{{0.00f, 0.00f, 0.00f},
                                                  {0.16f, 0.09f, 0.38f},
                                                  {0.43f, 0.11f, 0.50f},
                                                  {0.75f, 0.20f, 0.43f},
                                                  {0.95f, 0.41f, 0.30f},
                                                  {1.00f, 0.68f, 0.38f},
                                                  {1.00f, 0.98f, 0.78f}}};
    FloatImage result;
    result.width = values.width;
    result.height = values.height;
    result.channels = {"R", "G", "B"};
    result.pixels.reserve(values.pixels.size() * 3);
    const float scale = largest > 0.0f ? 1.0f / largest : 0.0f;
    constexpr float kLast = static_cast<float>(kStops.size() - 1);
    for (const float value : values.pixels) {
        const float t = std::clamp(value * scale, 0.0f, 1.0f) * kLast;
        const std::size_t i = std::min(static_cast<std::size_t>(t), kStops.size() - 2);
        const glm::vec3 color = glm::mix(kStops[i], kStops[i + 1], t - static_cast<float>(i));
        result.pixels.insert(result.pixels.end(), {color.r, color.g, color.b});
    }
    return result;
}

} // namespace celadon
