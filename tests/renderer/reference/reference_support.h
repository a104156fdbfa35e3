#pragma once

#include "renderer/scene/world.h"
#include "subedit/map/material_map.h"

#include <glm/glm.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

/// Materials and shapes for the tests of renderer/reference/.
namespace celadon::testing {

/// 2 pi integral of P r dr of a stored profile, by quadrature.
inline double storedAlbedo(const subedit::MaterialMap& map, int channel = 0, int x = 0, int y = 0) {
    double sum = 0;
    const double width = static_cast<double>(map.maxRadiusMm) / map.segments;
    constexpr int kSteps = 60; // even; Simpson's rule
    for (int k = 0; k < map.segments; ++k) {
        const double a = map.logKnot(x, y, k)[channel];
        const double b = map.logKnot(x, y, k + 1)[channel];
        for (int i = 0; i <= kSteps; ++i) {
            const double f = static_cast<double>(i) / kSteps;
            const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
            sum += weight / (3 * kSteps) * std::exp(a + (b - a) * f) * (k + f) * width * width;
        }
    }
    return 2 * std::numbers::pi * sum;
}

/// Albedo A and length l per channel: P = A (e^(-r/l) + e^(-r/3l)) / (8 pi l r), whose integral
/// over the plane is A; the first knot is such that the stored profile's integral is A as well.
inline void setTwoExponentials(subedit::MaterialMap& map, int x, int y, glm::dvec3 albedo,
                               glm::dvec3 lengthMm) {
    for (int c = 0; c < 3; ++c) {
        const double l = lengthMm[c];
        for (int k = 1; k <= map.segments; ++k) {
            const double r = static_cast<double>(map.maxRadiusMm) * k / map.segments;
            const double p = albedo[c] * (std::exp(-r / l) + std::exp(-r / (3 * l))) /
                             (8 * std::numbers::pi * l * r);
            map.logProfile[map.index(x, y, k) + c] =
                std::max(static_cast<float>(std::log(p)), subedit::kLogProfileFloor);
        }
        float low = map.logKnot(x, y, 1)[c];
        float high = low + 12;
        for (int i = 0; i < 40; ++i) {
            const float middle = 0.5f * (low + high);
            map.logProfile[map.index(x, y, 0) + c] = middle;
            (storedAlbedo(map, c, x, y) < albedo[c] ? low : high) = middle;
        }
    }
}

/// `cells` chooses albedo and length of each texel: {albedo, lengthMm}.
inline MaterialPointer
makeMaterial(int size, float maxRadiusMm, int segments,
             const std::function<std::pair<glm::dvec3, glm::dvec3>(int, int)>& cells,
             float eta = 1.3f) {
    auto map = std::make_shared<subedit::MaterialMap>();
    map->width = map->height = size;
    map->segments = segments;
    map->maxRadiusMm = maxRadiusMm;
    map->eta = eta;
    map->logProfile.resize(static_cast<std::size_t>(size) * size * map->knots() * 3);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto [albedo, length] = cells(x, y);
            setTwoExponentials(*map, x, y, albedo, length);
        }
    }
    return map;
}

/// Homogeneous. R_P(0.95) is about 6.7 l, and r_s = 18 l holds 99.8 % (largest channel).
inline MaterialPointer makeHomogeneous(glm::dvec3 lengthMm, float maxRadiusMm,
                                       glm::dvec3 albedo = {0.9, 0.7, 0.5}, float eta = 1.3f) {
    return makeMaterial(
        1, maxRadiusMm, 32, [&](int, int) { return std::pair(albedo, lengthMm); }, eta);
}

} // namespace celadon::testing
