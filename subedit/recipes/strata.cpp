#include "subedit/recipes/strata.h"

#include "subedit/recipes/appearance.h"
#include "subedit/recipes/noise.h"

#include <cmath>

namespace celadon::subedit {

MaterialMap bakeBandedOnyx(int size, const BakeSettings& settings) {
    constexpr int kLayers = 28; // whole, so that the map tiles from top to bottom
    const Appearance milk{{0.93f, 0.90f, 0.84f}, {8.0f, 7.0f, 5.8f}, 0.14f};
    const Appearance honey{{0.82f, 0.56f, 0.27f}, {14.0f, 10.0f, 6.4f}, 0.12f};
    const Appearance amber{{0.60f, 0.29f, 0.10f}, {16.5f, 9.6f, 5.2f}, 0.12f};
    const Appearance umber{{0.24f, 0.11f, 0.055f}, {7.0f, 4.4f, 3.0f}, 0.16f};
    const auto look = [&](glm::vec2 uv) {
        // Folds bend all layers alike; each layer has its own thickness and kind.
        const float fold =
            0.045f * fractalNoise(uv, 2, 4, 503u) + 0.012f * fractalNoise(uv, 9, 3, 509u);
        float height = (uv.y + fold) * kLayers;
        height -= static_cast<float>(kLayers) * std::floor(height / kLayers);
        const int layer = static_cast<int>(height) % kLayers;
        const float within = height - std::floor(height);
        const auto lookOf = [&](int which) {
            const int wrapped = (which + kLayers) % kLayers;
            const float kind = latticeRandom(wrapped, 0, 521u);
            const float tone = latticeRandom(wrapped, 1, 523u);
            if (kind < 0.40f) {
                return mix(milk, honey, 0.35f * tone);
            }
            if (kind < 0.85f) {
                return mix(honey, amber, tone);
            }
            return mix(amber, umber, 0.5f + 0.5f * tone);
        };
        const float border = 0.25f + 0.6f * latticeRandom(layer, 2, 541u);
        const Appearance band = mix(lookOf(layer), lookOf(layer + 1),
                                    smoothStep(border - 0.12f, border + 0.12f, within));
        const float cloud = smoothStep(0.10f, 0.60f, fractalNoise(uv, 8, 3, 547u));
        return mix(band, milk, 0.25f * cloud);
    };
    return bakeAppearance(evaluate("banded onyx", size, 1.49f, look), settings);
}

} // namespace celadon::subedit
