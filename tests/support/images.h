#pragma once

#include "renderer/output/image.h"

#include <cstdint>
#include <string>
#include <vector>

/// Small pictures for tests.
namespace celadon::test {

/// Every pixel holds `values`, one per channel.
inline FloatImage uniformImage(int width, int height, const std::vector<std::string>& channels,
                               const std::vector<float>& values) {
    FloatImage image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    for (int i = 0; i < width * height; ++i) {
        image.pixels.insert(image.pixels.end(), values.begin(), values.end());
    }
    return image;
}

/// Values in [0, 1), the same for the same seed everywhere (a linear congruential generator).
inline FloatImage noiseImage(int width, int height, const std::vector<std::string>& channels,
                             std::uint32_t seed) {
    FloatImage image =
        uniformImage(width, height, channels, std::vector<float>(channels.size(), 0.0f));
    std::uint32_t state = seed * 2654435761u + 1u;
    for (float& value : image.pixels) {
        state = state * 1664525u + 1013904223u;
        value = static_cast<float>(state >> 8) / static_cast<float>(1u << 24);
    }
    return image;
}

} // namespace celadon::test
