#include "subedit/select/stamp.h"

#include "subedit/assert.h"
#include "subedit/paint/stroke_mask.h"
#include "subedit/select/weight_filter.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::subedit {

namespace {

/// Right and up of the picture on the tangent plane.
struct Frame {
    glm::vec3 right, up;
};

Frame frameAt(const glm::vec3& normal, float angleDegrees) {
    const glm::vec3 upwards =
        std::abs(normal.y) < 0.99f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, -1.0f);
    const glm::vec3 right = glm::normalize(glm::cross(upwards, normal));
    const glm::vec3 up = glm::cross(normal, right);
    const float c = std::cos(glm::radians(angleDegrees));
    const float s = std::sin(glm::radians(angleDegrees));
    return {c * right + s * up, c * up - s * right};
}

/// Bilinear, zero outside. @param place pixels from the top left corner
float sample(const Stamp& stamp, const glm::vec2& place) {
    const auto at = [&](int x, int y) {
        return x < 0 || y < 0 || x >= stamp.width || y >= stamp.height
                   ? 0.0f
                   : static_cast<float>(stamp.weights[static_cast<std::size_t>(y) *
                                                          static_cast<std::size_t>(stamp.width) +
                                                      static_cast<std::size_t>(x)]) /
                         255.0f;
    };
    const float fx = place.x - 0.5f;
    const float fy = place.y - 0.5f;
    const int x = static_cast<int>(std::floor(fx));
    const int y = static_cast<int>(std::floor(fy));
    const float tx = fx - static_cast<float>(x);
    const float ty = fy - static_cast<float>(y);
    return (1.0f - ty) * ((1.0f - tx) * at(x, y) + tx * at(x + 1, y)) +
           ty * ((1.0f - tx) * at(x, y + 1) + tx * at(x + 1, y + 1));
}

} // namespace

WeightMask stampMask(const Surface& surface, const Stamp& stamp) {
    CELADON_ASSERT(stamp.width > 0 && stamp.height > 0 &&
                   stamp.weights.size() == static_cast<std::size_t>(stamp.width) *
                                               static_cast<std::size_t>(stamp.height));
    WeightMask mask(surface.width(), surface.height());
    const float pixelMm = stamp.widthMm / static_cast<float>(stamp.width);
    const glm::vec2 halfPx(0.5f * static_cast<float>(stamp.width),
                           0.5f * static_cast<float>(stamp.height));
    const float reachMm = 1.05f * pixelMm * glm::length(halfPx);
    const auto middle = StrokeMask::resolve(surface, stamp.at, reachMm);
    if (!middle) {
        return mask;
    }
    const Frame frame = frameAt(middle->normal, stamp.angleDegrees);
    for (const glm::vec3& signs : mirroredSides(stamp.mirror)) {
        StrokePoint there = *middle;
        there.positionMm = mirrored(stamp.mirror, signs, middle->positionMm);
        there.normal = signs * middle->normal;
        const auto onSurface = StrokeMask::resolve(surface, there, reachMm);
        if (!onSurface) {
            continue; // the object is not alike there
        }
        // One hard dab finds what the surface connects with the middle.
        StrokeMask reached(surface, {.radiusMm = reachMm, .hardness = 1.0f});
        reached.add(*onSurface);
        for (const Surface::Texel texel : reached.takeChanged()) {
            const glm::vec3 d = signs * (surface.positionMm(texel) - onSurface->positionMm);
            const glm::vec2 place =
                halfPx + glm::vec2(glm::dot(d, frame.right), -glm::dot(d, frame.up)) / pixelMm;
            const WeightMask::Weight weight =
                weightFromFloat(reached.weight(texel) * sample(stamp, place));
            mask.set(std::size_t{texel}, std::max(weight, mask.at(std::size_t{texel})));
        }
    }
    repeatInGutters(surface, mask);
    return mask;
}

} // namespace celadon::subedit
