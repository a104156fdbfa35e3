#include "subedit/recipes/jade.h"

#include "subedit/recipes/appearance.h"
#include "subedit/recipes/noise.h"

#include <cmath>

namespace celadon::subedit {

MaterialMap bakeJade(int size, const BakeSettings& settings) {
    const Appearance green{{0.36f, 0.68f, 0.40f}, {5.6f, 10.0f, 6.4f}, 0.20f};
    const Appearance emerald{{0.17f, 0.49f, 0.24f}, {4.2f, 8.0f, 4.8f}, 0.18f};
    const Appearance pale{{0.84f, 0.90f, 0.76f}, {5.2f, 6.4f, 5.2f}, 0.24f};
    const Appearance dark{{0.035f, 0.14f, 0.06f}, {2.6f, 5.0f, 3.0f}, 0.22f};
    const auto look = [&](glm::vec2 uv) {
        const glm::vec2 warped = uv + 0.07f * warpNoise(uv, 4, 3, 101u);
        const float depth = smoothStep(-0.35f, 0.40f, fractalNoise(warped, 4, 3, 103u));
        const float cloud = smoothStep(0.02f, 0.55f, fractalNoise(warped, 6, 4, 107u));
        const float ridge = std::abs(fractalNoise(warped, 5, 3, 109u));
        const float vein = smoothStep(0.09f, 0.015f, ridge) *
                           smoothStep(-0.10f, 0.25f, fractalNoise(uv, 5, 2, 113u));
        return mix(mix(mix(green, emerald, depth), pale, cloud), dark, 0.85f * vein);
    };
    return bakeAppearance(evaluate("jade", size, 1.62f, look), settings);
}

} // namespace celadon::subedit
