#include "renderer/output/flip.h"

#include "renderer/output/image_compare.h"
#include "renderer/output/separable_filter.h"
#include "subedit/assert.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace celadon {
namespace {

using Color = glm::dvec3;
using std::numbers::pi;

// --- Color spaces -------------------------------------------------------------------------------

/// Linear sRGB to CIE XYZ for D65 (IEC 61966-2-1); glm takes columns.
const glm::dmat3 kRgbToXyz{0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522,
                           0.1191920, 0.1804375, 0.0721750, 0.9503041};
const glm::dmat3 kXyzToRgb = glm::inverse(kRgbToXyz);
const Color kWhite = kRgbToXyz * Color(1.0); // of the illuminant, as this matrix has it

/// Linearized CIELAB, in which the eye's spatial filters work (2020, eq. 2; Zhang, Wandell 1997).
Color rgbToYcxcz(Color rgb) {
    const Color xyz = kRgbToXyz * rgb / kWhite;
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

Color ycxczToRgb(Color c) {
    const double y = (c.x + 16.0) / 116.0;
    return kXyzToRgb * (Color(y + c.y / 500.0, y, y - c.z / 200.0) * kWhite);
}

Color rgbToLab(Color rgb) {
    constexpr double delta = 6.0 / 29.0;
    const auto f = [](double t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const Color xyz = kRgbToXyz * rgb / kWhite;
    return {116.0 * f(xyz.y) - 16.0, 500.0 * (f(xyz.x) - f(xyz.y)), 200.0 * (f(xyz.y) - f(xyz.z))};
}

/// Colors look less colorful the darker they are (Hunt 1952; 2020, eq. 7).
Color huntAdjust(Color lab) {
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// City block in lightness, Euclidean in chroma (Abasi et al. 2020; 2020, eq. 8).
double hyAb(Color a, Color b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// --- Color pipeline -----------------------------------------------------------------------------

/// Contrast sensitivity as a sum of two Gaussians in space, parameters of 2020, table 1:
/// sum_i a_i sqrt(pi / b_i) exp(-pi^2 x^2 / b_i), x in degrees.
struct Sensitivity {
    std::array<double, 2> a;
    std::array<double, 2> b;
};
constexpr std::array<Sensitivity, 3> kSensitivities = {
    {{{1.0, 0.0}, {0.0047, 1e-5}}, {{1.0, 0.0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}}};
constexpr double kWidestB = 0.04;

/// The filter of one opponent channel, normalized to sum 1 over its square support. Each term is
/// separable, their sum is not: filtered apart, then added with the terms' shares.
Plane filterBySensitivity(const Plane& plane, const Sensitivity& sensitivity, double ppd) {
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestB / (2.0 * pi * pi)) * ppd));
    std::array<double, 2> share{};
    std::array<double, 2> sigma{};
    for (std::size_t i = 0; i < 2; ++i) {
        sigma[i] = std::sqrt(sensitivity.b[i] / (2.0 * pi * pi)) * ppd;
        double sum = 0.0;
        for (int x = -radius; x <= radius; ++x) {
            sum += std::exp(-0.5 * x * x / (sigma[i] * sigma[i]));
        }
        share[i] = sensitivity.a[i] * std::sqrt(pi / sensitivity.b[i]) * sum * sum;
    }
    const double total = share[0] + share[1];
    Plane result(plane.width, plane.height);
    for (std::size_t i = 0; i < 2; ++i) {
        if (share[i] == 0.0) {
            continue;
        }
        const std::vector<double> kernel = gaussianKernel(sigma[i], radius);
        const Plane filtered = filterSeparable(plane, kernel, kernel);
        const double weight = share[i] / total;
        for (std::size_t p = 0; p < result.values.size(); ++p) {
            result.values[p] += weight * filtered.values[p];
        }
    }
    return result;
}

struct Opponents {
    std::array<Plane, 3> planes; ///< Y, Cx, Cz
};

Opponents toOpponents(const FloatImage& image) {
    const Plane empty(image.width, image.height);
    Opponents result{{empty, empty, empty}};
    for (std::size_t i = 0; i < empty.values.size(); ++i) {
        const float* rgb = image.pixels.data() + i * image.channelCount();
        Color color;
        for (int c = 0; c < 3; ++c) {
            color[c] = std::clamp(static_cast<double>(rgb[c]), 0.0, 1.0);
        }
        const Color opponent = rgbToYcxcz(color);
        for (std::size_t c = 0; c < 3; ++c) {
            result.planes[c].values[i] = opponent[static_cast<int>(c)];
        }
    }
    return result;
}

/// What the eye resolves, in Hunt-adjusted L*a*b* (2020, section 4.1).
std::vector<Color> perceivedColors(const Opponents& opponents, double ppd) {
    std::array<Plane, 3> filtered = opponents.planes;
    for (std::size_t c = 0; c < 3; ++c) {
        filtered[c] = filterBySensitivity(opponents.planes[c], kSensitivities[c], ppd);
    }
    std::vector<Color> colors(filtered[0].values.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const Color rgb =
            ycxczToRgb({filtered[0].values[i], filtered[1].values[i], filtered[2].values[i]});
        colors[i] = huntAdjust(rgbToLab(glm::clamp(rgb, Color(0.0), Color(1.0))));
    }
    return colors;
}

/// Compresses large distances, whose size hardly matters any more, to [0, 1] (2020, eq. 9).
double colorDifference(Color a, Color b) {
    constexpr double qc = 0.7;
    constexpr double pc = 0.4;
    constexpr double pt = 0.95;
    // The largest distance in the sRGB cube: from green to blue.
    static const double largest =
        std::pow(hyAb(huntAdjust(rgbToLab({0, 1, 0})), huntAdjust(rgbToLab({0, 0, 1}))), qc);
    const double distance = std::pow(hyAb(a, b), qc);
    const double bend = pc * largest;
    if (distance < bend) {
        return distance * pt / bend;
    }
    return std::min(1.0, pt + (distance - bend) / (largest - bend) * (1.0 - pt));
}

// --- Feature pipeline ---------------------------------------------------------------------------

/// Derivative kernels scaled so that positive weights sum to 1 and negative ones to -1.
std::vector<double> balanced(const std::vector<double>& weights, double perpendicularSum) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double w : weights) {
        (w > 0.0 ? positive : negative) += std::abs(w) * perpendicularSum;
    }
    std::vector<double> result;
    for (const double w : weights) {
        result.push_back(w * perpendicularSum / (w > 0.0 ? positive : negative));
    }
    return result;
}

struct Features {
    Plane edges;  ///< gradient magnitude
    Plane points; ///< second-derivative magnitude
};

Plane magnitude(const Plane& x, const Plane& y) {
    Plane result(x.width, x.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] = std::hypot(x.values[i], y.values[i]);
    }
    return result;
}

/// Edges and points of the achromatic channel (2020, section 4.2), by first and second derivatives
/// of a Gaussian whose width matches the eye's edge detectors (0.082 degrees, section 4.2.2).
Features detectFeatures(const Plane& opponentY, double ppd) {
    constexpr double kWidthDegrees = 0.082;
    const double sigma = 0.5 * kWidthDegrees * ppd;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));

    Plane luminance = opponentY;
    for (double& value : luminance.values) {
        value = (value + 16.0) / 116.0;
    }
    std::vector<double> first;
    std::vector<double> second;
    double gaussianSum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-0.5 * x * x / (sigma * sigma));
        gaussianSum += g;
        first.push_back(-x * g);
        second.push_back((x * x / (sigma * sigma) - 1.0) * g);
    }
    const std::vector<double> smooth = gaussianKernel(sigma, radius);
    const std::vector<double> edge = balanced(first, gaussianSum);
    const std::vector<double> point = balanced(second, gaussianSum);
    return {magnitude(filterSeparable(luminance, edge, smooth),
                      filterSeparable(luminance, smooth, edge)),
            magnitude(filterSeparable(luminance, point, smooth),
                      filterSeparable(luminance, smooth, point))};
}

/// 2020, eq. 11.
double featureDifference(const Features& a, const Features& b, std::size_t i) {
    constexpr double qf = 0.5;
    const double edges = std::abs(a.edges.values[i] - b.edges.values[i]);
    const double points = std::abs(a.points.values[i] - b.points.values[i]);
    return std::min(1.0, std::pow(std::max(edges, points) / std::numbers::sqrt2, qf));
}

// --- High dynamic range -------------------------------------------------------------------------

double luminance(const float* rgb) {
    return 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
}

/// Narkowicz 2015, in the form that Andersson et al. 2021 use (exposure 0.6 folded in).
constexpr std::array<double, 6> kCurve{0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0,
                                       0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

FloatImage exposed(const FloatImage& image, double stops) {
    FloatImage result = image;
    const double gain = std::exp2(stops);
    for (float& value : result.pixels) {
        const double x = std::max(0.0, static_cast<double>(value)) * gain;
        const double mapped = ((kCurve[0] * x + kCurve[1]) * x + kCurve[2]) /
                              ((kCurve[3] * x + kCurve[4]) * x + kCurve[5]);
        value = static_cast<float>(std::min(mapped, 1.0));
    }
    return result;
}

struct ExposureRange {
    double start = 0.0;
    double stop = 0.0;
};

/// From where the brightest pixel to where the median one is shown at 0.85 (2021, section 3.2).
ExposureRange exposureRange(const FloatImage& reference) {
    constexpr double kWellExposed = 0.85;
    constexpr double kMostStops = 24.0;
    const double a = kCurve[0] - kWellExposed * kCurve[3];
    const double b = kCurve[1] - kWellExposed * kCurve[4];
    const double c = kCurve[2] - kWellExposed * kCurve[5];
    const double shown = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);

    std::vector<float> luminances;
    float brightest = 0.0f;
    for (std::size_t i = 0; i < reference.pixels.size(); i += reference.channelCount()) {
        const auto y = static_cast<float>(luminance(reference.pixels.data() + i));
        if (y > 0.0f) {
            luminances.push_back(y);
            brightest = std::max(brightest, y);
        }
    }
    if (luminances.empty()) {
        return {};
    }
    const double median = percentile(std::move(luminances), 50.0);
    const double start = std::log2(shown / brightest);
    return {start, std::min(std::log2(shown / median), start + kMostStops)};
}

} // namespace

FloatImage flipMap(const FloatImage& a, const FloatImage& b, double pixelsPerDegree) {
    CELADON_ASSERT(a.width == b.width && a.height == b.height);
    CELADON_ASSERT(a.channelCount() == 3 && b.channelCount() == 3);
    const Opponents opponentsA = toOpponents(a);
    const Opponents opponentsB = toOpponents(b);
    const std::vector<Color> colorsA = perceivedColors(opponentsA, pixelsPerDegree);
    const std::vector<Color> colorsB = perceivedColors(opponentsB, pixelsPerDegree);
    const Features featuresA = detectFeatures(opponentsA.planes[0], pixelsPerDegree);
    const Features featuresB = detectFeatures(opponentsB.planes[0], pixelsPerDegree);

    FloatImage result;
    result.width = a.width;
    result.height = a.height;
    result.channels = {"flip"};
    result.pixels.resize(colorsA.size());
    for (std::size_t i = 0; i < colorsA.size(); ++i) {
        const double color = colorDifference(colorsA[i], colorsB[i]);
        const double feature = featureDifference(featuresA, featuresB, i);
        result.pixels[i] = static_cast<float>(std::pow(color, 1.0 - feature)); // 2020, eq. 12
    }
    return result;
}

FloatImage hdrFlipMap(const FloatImage& test, const FloatImage& reference, double pixelsPerDegree) {
    const ExposureRange range = exposureRange(reference);
    const int count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
    FloatImage largest;
    for (int i = 0; i < count; ++i) {
        const double stops = range.start + (range.stop - range.start) * i / (count - 1);
        const FloatImage map =
            flipMap(exposed(test, stops), exposed(reference, stops), pixelsPerDegree);
        if (i == 0) {
            largest = map;
            continue;
        }
        for (std::size_t p = 0; p < map.pixels.size(); ++p) {
            largest.pixels[p] = std::max(largest.pixels[p], map.pixels[p]);
        }
    }
    return largest;
}

double meanValue(const FloatImage& image) {
    const double sum = std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
    return image.pixels.empty() ? 0.0 : sum / static_cast<double>(image.pixels.size());
}

} // namespace celadon
