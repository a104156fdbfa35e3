#pragma once

#include "renderer/frame_renderer.h"
#include "renderer/output/image_compare.h"
#include "tests/support/worlds.h"

#include <glm/glm.hpp>

#include <span>

/// Small frames with their layers, for tests of what the renderer computes.
namespace celadon::test {

/// Every scheme of the splatting solver: tests of the renderer run once for each.
inline constexpr Scheme kSchemes[] = {Scheme::Paper, Scheme::Hierarchical};

inline const char* schemeWord(Scheme scheme) {
    return scheme == Scheme::Paper ? "paper" : "hierarchical";
}

/// Layers read back, no highlights, no antialiasing: what is not tested costs nothing.
inline FrameSettings smallFrame(glm::ivec2 size, int irradianceSize,
                                Scheme scheme = Scheme::Paper) {
    FrameSettings settings;
    settings.size = size;
    settings.splatting.scheme = scheme;
    settings.splatting.irradianceSize = irradianceSize;
    if (scheme == Scheme::Hierarchical) {
        settings.splatting.energy = 1.0; // as the command line has it
    }
    settings.specular = false;
    settings.coverageSamples = 1;
    settings.shadowSize = 64;
    settings.layers = true;
    return settings;
}

/// One frame by a renderer of its own.
inline RenderedFrame renderFrame(const gl::Context& context, const World& world,
                                 const FrameSettings& settings, const Camera& camera,
                                 std::span<const Light> lights) {
    return FrameRenderer(context, world, settings).render(camera, lights);
}

inline glm::dvec3 valueAt(const FloatImage& image, const char* layer, glm::ivec2 pixel,
                          const char* suffixes) {
    glm::dvec3 value;
    for (int c = 0; c < 3; ++c) {
        const int channel = image.channelIndex(std::string(layer) + "." + suffixes[c]);
        value[c] = static_cast<double>(image.at(pixel.x, pixel.y, channel));
    }
    return value;
}

/// B in W/m^2 at a pixel, top row first.
inline glm::dvec3 exitanceAt(const FloatImage& image, glm::ivec2 pixel) {
    return valueAt(image, "exitance", pixel, "RGB");
}
inline glm::dvec3 positionAt(const FloatImage& image, glm::ivec2 pixel) {
    return valueAt(image, "position", pixel, "XYZ");
}
/// R_P is positive exactly where scattering surface is seen.
inline bool seesScattering(const FloatImage& image, glm::ivec2 pixel) {
    return image.at(pixel.x, pixel.y, image.channelIndex("radius")) > 0.0f;
}

/// Differences of the exitance layers over all pixels; background is zero in both.
inline ValueErrors compareExitance(const FloatImage& image, const FloatImage& reference) {
    return compareValues(extractLayer(image, "exitance"), extractLayer(reference, "exitance"));
}

} // namespace celadon::test
