#include "app/material/map_argument.h"

#include "app/rgb_argument.h"
#include "subedit/errors.h"
#include "subedit/medium.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace celadon::app {

using namespace subedit;

ImageMap readMap(const std::string& text, ImageMeaning meaning) {
    if (const std::optional<glm::dvec3> constant = parseRgb(text)) {
        return {1, 1, {glm::vec3(*constant)}};
    }
    return readImageMap(text, meaning);
}

void checkRange(const std::string& option, const std::string& text, const ImageMap& map, float low,
                float high) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const float value = map.values[i][channel];
            if (!(value >= low && value <= high)) {
                if (parseRgb(text)) {
                    throw UsageError(fmt::format("{} {}", option, text),
                                     fmt::format("{} is {}, not in [{}, {}]", channelName(channel),
                                                 value, low, high));
                }
                const auto width = static_cast<std::size_t>(map.width);
                throw InputError(fmt::format("{} '{}'", option, text),
                                 fmt::format("{} is {} at pixel ({}, {}), not in [{}, {}]",
                                             channelName(channel), value, i % width, i / width, low,
                                             high));
            }
        }
    }
}

void checkMapMemory(const std::string& command, double texels, int segments) {
    constexpr double kMostBytes = 4e9;
    const double bytes = texels * (segments + 1) * 3 * sizeof(float);
    if (bytes > kMostBytes) {
        throw UsageError(command,
                         fmt::format("{:.3g} million texels of {} segments are {:.1f} GB",
                                     texels * 1e-6, segments, bytes * 1e-9),
                         "give a smaller --size");
    }
}

void decodeSrgb(ImageMap& map) {
    for (glm::vec3& value : map.values) {
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = value[channel];
            value[channel] = encoded <= 0.04045f ? encoded / 12.92f
                                                 : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
        }
    }
}

} // namespace celadon::app
