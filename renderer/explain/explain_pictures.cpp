#include "renderer/explain/explain_pictures.h"

#include "renderer/output/tone_map.h"
#include "subedit/effective_radius.h"
#include "subedit/radius_map.h"

#include <glm/common.hpp>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon {

namespace {

const glm::vec3 kGround(0.075f, 0.080f, 0.083f); ///< around a picture, sRGB
constexpr float kMargin = 0.04f;                 ///< of a square picture's side, left free
constexpr float kSameSurface = 0.015f;           ///< relative difference of depths

void put(DisplayPixels& picture, int x, int y, const glm::vec3& color, float opacity = 1.0f) {
    std::uint8_t* const pixel =
        picture.rgba.data() +
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.x) +
         static_cast<std::size_t>(x)) *
            4;
    for (int c = 0; c < 3; ++c) {
        const float before = static_cast<float>(pixel[c]) / 255.0f;
        const float now = glm::mix(before, glm::clamp(color[c], 0.0f, 1.0f), opacity);
        pixel[c] = static_cast<std::uint8_t>(std::lround(255.0f * now));
    }
    pixel[3] = 255;
}

glm::vec3 encoded(const glm::vec3& linear) {
    return {encodeSrgb(linear.r), encodeSrgb(linear.g), encodeSrgb(linear.b)};
}

/// A square in the middle.
/// @param colorAt of a place in it, (0,0) top left, to an sRGB color; called from several threads
template<typename ColorAt>
DisplayPixels squarePicture(glm::ivec2 size, ColorAt&& colorAt) {
    DisplayPixels picture{size, std::vector<std::uint8_t>(static_cast<std::size_t>(size.x) *
                                                          static_cast<std::size_t>(size.y) * 4)};
    const float side = (1.0f - 2.0f * kMargin) * static_cast<float>(std::min(size.x, size.y));
    const glm::vec2 low = 0.5f * (glm::vec2(size) - side);
    tbb::parallel_for(0, size.y, [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::vec2 up = (glm::vec2(x, y) + 0.5f - low) / side;
            const bool isInside = up.x >= 0.0f && up.y >= 0.0f && up.x < 1.0f && up.y < 1.0f;
            put(picture, x, y, isInside ? colorAt(glm::vec2(up.x, 1.0f - up.y)) : kGround);
        }
    });
    return picture;
}

struct FluxLevel {
    int side = 0;
    std::vector<glm::vec3> flux; ///< mean per lit level-0 texel; zero where nothing is lit
};

/// Means over the lit texels of 2^level squares: as the mips of the irradiance buffer.
FluxLevel fluxLevel(const LightTexels& texels, int level) {
    const int step = 1 << level;
    FluxLevel result;
    result.side = (texels.size + step - 1) / step;
    for (int y = 0; y < result.side; ++y) {
        for (int x = 0; x < result.side; ++x) {
            glm::vec3 sum(0.0f);
            int lit = 0;
            for (int j = y * step; j < std::min((y + 1) * step, texels.size); ++j) {
                for (int i = x * step; i < std::min((x + 1) * step, texels.size); ++i) {
                    const float* const flux =
                        texels.fluxes + 4 * (static_cast<std::ptrdiff_t>(j) * texels.stride + i);
                    const glm::vec3 value(flux[0], flux[1], flux[2]);
                    lit += value.r + value.g + value.b > 0.0f ? 1 : 0;
                    sum += value;
                }
            }
            result.flux.push_back(lit > 0 ? sum / static_cast<float>(lit) : sum);
        }
    }
    return result;
}

} // namespace

glm::vec3 levelColor(int level) {
    // Okabe and Ito's palette, which color-blind people can tell apart, a little lighter.
    static constexpr std::array<glm::vec3, 8> kColors{
        glm::vec3(0.95f, 0.90f, 0.35f), glm::vec3(0.94f, 0.66f, 0.10f),
        glm::vec3(0.88f, 0.42f, 0.10f), glm::vec3(0.84f, 0.52f, 0.70f),
        glm::vec3(0.38f, 0.74f, 0.94f), glm::vec3(0.10f, 0.50f, 0.80f),
        glm::vec3(0.10f, 0.68f, 0.52f), glm::vec3(0.80f, 0.80f, 0.80f)};
    return kColors[static_cast<std::size_t>(level) % kColors.size()];
}

DisplayPixels irradiancePicture(const LightTexels& texels, int level, glm::ivec2 size) {
    const int finest = std::max(texels.size, 1);
    int most = 0;
    while ((finest >> (most + 1)) > 0) {
        ++most;
    }
    const FluxLevel shown = fluxLevel(texels, std::clamp(level, 0, most));
    float brightest = 1e-20f;
    for (const glm::vec3& flux : shown.flux) {
        brightest = std::max({brightest, flux.r, flux.g, flux.b});
    }
    return squarePicture(size, [&](glm::vec2 place) {
        const auto at = [&](float t) {
            return std::min(static_cast<int>(t * static_cast<float>(shown.side)), shown.side - 1);
        };
        // Rows of the light view run from the bottom.
        const auto i = static_cast<std::size_t>(at(1.0f - place.y) * shown.side + at(place.x));
        const glm::vec3 flux = shown.flux[i];
        return flux == glm::vec3(0.0f) ? 1.6f * kGround : encoded(flux / brightest);
    });
}

void drawSamples(std::span<const ShownSample> samples, const CameraView& camera,
                 const float* positions, int stride, DisplayPixels& picture) {
    // Coarse ones first, so that fine ones stay visible.
    std::vector<const ShownSample*> order;
    for (const ShownSample& sample : samples) {
        order.push_back(&sample);
    }
    std::ranges::stable_sort(order,
                             [](const auto* a, const auto* b) { return a->level > b->level; });
    const glm::vec2 size(picture.size);
    for (const ShownSample* sample : order) {
        const glm::vec4 eye = camera.view * glm::vec4(sample->positionMm, 1.0f);
        const glm::vec4 clip = camera.projection * eye;
        if (clip.w <= 0.0f) {
            continue;
        }
        const glm::vec2 at = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
        const float depth = -eye.z;
        const auto widthMm = static_cast<float>(
            camera.pixelWidth.atDepthMm(static_cast<double>(depth))); // of a pixel there
        const glm::ivec2 middle(glm::floor(at));
        if (middle.x < 0 || middle.y < 0 || middle.x >= picture.size.x ||
            middle.y >= picture.size.y) {
            continue;
        }
        const float seen =
            positions[4 * (static_cast<std::ptrdiff_t>(middle.y) * stride + middle.x) + 3];
        const bool isHidden = seen > 0.0f && depth > seen * (1.0f + kSameSurface);
        const float footprint = 0.35f * sample->radiusMm / widthMm;
        const float radius = std::clamp(footprint, 0.5f, isHidden ? 2.0f : 7.0f);
        const float opacity = isHidden ? 0.16f : 0.9f;
        const int reach = static_cast<int>(std::ceil(radius));
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const glm::ivec2 p = middle + glm::ivec2(x, y);
                const float distance = std::sqrt(static_cast<float>(x * x + y * y));
                if (p.x < 0 || p.y < 0 || p.x >= picture.size.x || p.y >= picture.size.y ||
                    distance > radius) {
                    continue;
                }
                put(picture, p.x, p.y, levelColor(sample->level), opacity);
            }
        }
    }
}

DisplayPixels atlasPicture(const subedit::MaterialMap& map, const subedit::Surface& surface,
                           glm::ivec2 size) {
    using Texel = subedit::Surface::Texel;
    const float side = static_cast<float>(std::min(size.x, size.y));
    const glm::ivec2 extent(surface.width(), surface.height());
    const auto texelAt = [&](glm::ivec2 p) {
        p = glm::clamp(p, glm::ivec2(0), extent - 1);
        return static_cast<Texel>(p.y * extent.x + p.x);
    };
    // A line is two pixels of the picture wide, and at least a texel.
    const int line =
        std::max(1, static_cast<int>(std::lround(1.2f * static_cast<float>(extent.x) / side)));
    return squarePicture(size, [&](glm::vec2 place) {
        const glm::ivec2 p(place * glm::vec2(extent));
        const Texel texel = texelAt(p);
        const auto chart = surface.chartOf(texel);
        bool isBorder = false;
        for (const glm::ivec2 step : {glm::ivec2(line, 0), glm::ivec2(-line, 0),
                                      glm::ivec2(0, line), glm::ivec2(0, -line)}) {
            isBorder |= chart >= 0 && surface.chartOf(texelAt(p + step)) != chart;
        }
        if (isBorder) {
            return glm::vec3(0.56f, 0.78f, 0.66f);
        }
        if (chart < 0) {
            return 0.6f * kGround;
        }
        const glm::ivec2 q = glm::clamp(p, glm::ivec2(0), extent - 1);
        return encoded(glm::vec3(subedit::diffuseAlbedo(subedit::profileAt(map, q.x, q.y))));
    });
}

} // namespace celadon
