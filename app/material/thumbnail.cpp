#include "app/material/thumbnail.h"

#include "subedit/radius_map.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::app {

namespace {

using namespace subedit;

constexpr int kHeight = 256;
constexpr int kGap = 8;

float encodeSrgb(float linear) {
    const float value = std::clamp(linear, 0.0f, 1.0f);
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

/// Per texel: albedo, and radii over the largest of the map.
struct Looks {
    std::vector<glm::vec3> albedo, radius;
};

Looks computeLooks(const MaterialMap& map) {
    Looks looks;
    const std::vector<float> albedo = albedoMap(map);
    float largest = 1e-6f;
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const std::size_t i = looks.albedo.size() * 3;
            looks.albedo.emplace_back(albedo[i], albedo[i + 1], albedo[i + 2]);
            looks.radius.emplace_back(effectiveRadiusMm(profileAt(map, x, y)));
            const glm::vec3& radius = looks.radius.back();
            largest = std::max({largest, radius.x, radius.y, radius.z});
        }
    }
    for (glm::vec3& radius : looks.radius) {
        radius /= largest;
    }
    return looks;
}

/// Mean over the texels that a pixel covers, or the nearest one.
glm::vec3 sampleBox(const MaterialMap& map, const std::vector<glm::vec3>& values, int x, int y,
                    int width) {
    const auto range = [](int pixel, int pixels, int texels) {
        const int from = pixel * texels / pixels;
        return std::pair{from, std::max(from + 1, (pixel + 1) * texels / pixels)};
    };
    const auto [x0, x1] = range(x, width, map.width);
    const auto [y0, y1] = range(y, kHeight, map.height);
    glm::vec3 sum(0.0f);
    for (int ty = y0; ty < y1; ++ty) {
        for (int tx = x0; tx < x1; ++tx) {
            sum += values[static_cast<std::size_t>(ty) * static_cast<std::size_t>(map.width) +
                          static_cast<std::size_t>(tx)];
        }
    }
    return sum / static_cast<float>((x1 - x0) * (y1 - y0));
}

} // namespace

FloatImage drawThumbnail(const MaterialMap& map) {
    const Looks looks = computeLooks(map);
    const int width = std::clamp(kHeight * map.width / map.height, 64, 1024);
    FloatImage image{2 * width + kGap, kHeight, {"R", "G", "B"}, {}};
    image.pixels.assign(static_cast<std::size_t>(image.width) * kHeight * 3, 1.0f);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 albedo = sampleBox(map, looks.albedo, x, y, width);
            const glm::vec3 radius = sampleBox(map, looks.radius, x, y, width);
            for (int channel = 0; channel < 3; ++channel) {
                image.at(x, y, channel) = encodeSrgb(albedo[channel]);
                image.at(x + width + kGap, y, channel) = encodeSrgb(radius[channel]);
            }
        }
    }
    return image;
}

} // namespace celadon::app
