#include "renderer/output/tone_map.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace celadon {
namespace {

float unit(float value) {
    // The comparison is false for NaN, which so becomes 0.
    return value > 0.0f ? std::min(value, 1.0f) : 0.0f;
}

glm::vec3 unit(glm::vec3 c) {
    return {unit(c.x), unit(c.y), unit(c.z)};
}

/// Khronos 2024, "Khronos PBR Neutral Tone Mapper", its specification's symbols.
glm::vec3 neutral(glm::vec3 color) {
    constexpr float kF90 = 0.04f; // Fresnel reflection at normal incidence, taken out
    constexpr float kCompressionStart = 0.8f - kF90;
    constexpr float kDesaturation = 0.15f;

    const float x = std::min({color.x, color.y, color.z});
    const float offset = x < 2.0f * kF90 ? x - x * x / (4.0f * kF90) : kF90;
    color -= offset;
    const float peak = std::max({color.x, color.y, color.z});
    if (peak < kCompressionStart) {
        return color;
    }
    constexpr float d = 1.0f - kCompressionStart;
    const float newPeak = 1.0f - d * d / (peak + d - kCompressionStart);
    const float towardsWhite = 1.0f - 1.0f / (kDesaturation * (peak - newPeak) + 1.0f);
    return glm::mix(color * (newPeak / peak), glm::vec3(newPeak), towardsWhite);
}

/// Narkowicz 2015. He fitted the curve with exposure 1/0.6 folded in; 0.6 takes it out, so that
/// middle gray stays about where the reference transform has it.
float aces(float x) {
    x *= 0.6f;
    return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

struct ColorChannels {
    int r, g, b, a; ///< a < 0: opaque
};

ColorChannels colorChannels(const FloatImage& image) {
    const ColorChannels c{image.channelIndex("R"), image.channelIndex("G"), image.channelIndex("B"),
                          image.channelIndex("A")};
    if (c.r < 0 || c.g < 0 || c.b < 0) {
        throw UsageError("picture", "it has no R, G and B channels");
    }
    return c;
}

} // namespace

ToneMap parseToneMap(std::string_view word) {
    for (const ToneMap toneMap : {ToneMap::Neutral, ToneMap::Aces, ToneMap::None}) {
        if (word == toneMapName(toneMap)) {
            return toneMap;
        }
    }
    throw UsageError(fmt::format("'{}'", word), "is no tone map", "choose neutral, aces or none");
}

const char* toneMapName(ToneMap toneMap) {
    switch (toneMap) {
    case ToneMap::Neutral:
        return "neutral";
    case ToneMap::Aces:
        return "aces";
    case ToneMap::None:
        break;
    }
    return "none";
}

float encodeSrgb(float linear) {
    const float x = unit(linear);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb(float encoded) {
    const float x = unit(encoded);
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 applyToneMap(ToneMap toneMap, glm::vec3 color) {
    // The largest float keeps the curves' quotients finite: they are ratios of squares.
    constexpr float kLargest = 1e15f;
    for (int i = 0; i < 3; ++i) {
        color[i] = color[i] > 0.0f ? std::min(color[i], kLargest) : 0.0f;
    }
    switch (toneMap) {
    case ToneMap::Neutral:
        return unit(neutral(color));
    case ToneMap::Aces:
        return unit({aces(color.x), aces(color.y), aces(color.z)});
    case ToneMap::None:
        break;
    }
    return unit(color);
}

FloatImage toDisplayLight(FloatImage color, ToneMap toneMap, float exposureEv) {
    const float gain = std::exp2(exposureEv);
    for (std::size_t i = 0; i + 3 <= color.pixels.size(); i += 3) {
        float* pixel = color.pixels.data() + i;
        const glm::vec3 light =
            applyToneMap(toneMap, glm::vec3(pixel[0], pixel[1], pixel[2]) * gain);
        std::copy_n(&light.x, 3, pixel);
    }
    return color;
}

FloatImage toDisplay(const FloatImage& linear, const DisplaySettings& settings) {
    const ColorChannels in = colorChannels(linear);
    const bool keepsAlpha = in.a >= 0 && !settings.background;
    const float gain = std::exp2(settings.exposureEv);

    FloatImage out;
    out.width = linear.width;
    out.height = linear.height;
    out.channels = {"R", "G", "B"};
    if (keepsAlpha) {
        out.channels.emplace_back("A");
    }
    const std::size_t count =
        static_cast<std::size_t>(linear.width) * static_cast<std::size_t>(linear.height);
    out.pixels.resize(count * out.channels.size());

    const float* source = linear.pixels.data();
    float* target = out.pixels.data();
    for (std::size_t i = 0; i < count;
         ++i, source += linear.channelCount(), target += out.channelCount()) {
        const float alpha = in.a >= 0 ? unit(source[in.a]) : 1.0f;
        // The curve is for the object's own color; scaling by coverage comes after, or
        // half-covered pixels of a bright edge would be compressed less than the inside.
        glm::vec3 color{0.0f};
        if (alpha > 0.0f) {
            const glm::vec3 straight =
                glm::vec3(source[in.r], source[in.g], source[in.b]) / alpha * gain;
            color = applyToneMap(settings.toneMap, straight);
        }
        if (settings.background) {
            color = color * alpha + unit(*settings.background) * (1.0f - alpha);
        }
        for (int c = 0; c < 3; ++c) {
            target[c] = encodeSrgb(color[c]);
        }
        if (keepsAlpha) {
            target[3] = alpha;
        }
    }
    return out;
}

FloatImage compositeOver(FloatImage premultiplied, glm::vec3 background) {
    const ColorChannels c = colorChannels(premultiplied);
    if (c.a < 0) {
        return premultiplied;
    }
    const std::size_t stride = premultiplied.channelCount();
    for (std::size_t i = 0; i + stride <= premultiplied.pixels.size(); i += stride) {
        float* pixel = premultiplied.pixels.data() + i;
        const float rest = 1.0f - unit(pixel[c.a]);
        pixel[c.r] += rest * background.r;
        pixel[c.g] += rest * background.g;
        pixel[c.b] += rest * background.b;
        pixel[c.a] = 1.0f;
    }
    return premultiplied;
}

} // namespace celadon
