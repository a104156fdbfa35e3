#include "subedit/recipes/jade.h"

#include "subedit/recipes/appearance.h"
#include "subedit/recipes/noise.h"

#include <cmath>

namespace celadon::subedit {

MaterialMap bakeJade(int size, const BakeSettings& settings) {
    const Appearance green{{0.22f, 0.62f, 0.30f}, {5.2f, 10.0f, 6.2f}, 0.20f};
    const Appearance emerald{{0.10f, 0.46f, 0.19f}, {4.0f, 8.0f, 4.8f}, 0.18f};
    const Appearance pale{{0.70f, 0.84f, 0.66f}, {5.0f, 6.6f, 5.2f}, 0.24f};
    const Appearance dark{{0.045f, 0.20f, 0.08f}, {2.6f, 5.0f, 3.0f}, 0.22f};
    const auto look = [&](glm::vec2 uv) {
        const glm::vec2 warped = uv + 0.07f * warpNoise(uv, 4, 3, 101u);
        const float depth = smoothStep(-0.35f, 0.40f, fractalNoise(warped, 4, 3, 103u));
        const float cloud = smoothStep(0.12f, 0.62f, fractalNoise(warped, 5, 4, 107u));
        const float ridge = std::abs(fractalNoise(warped, 5, 3, 109u));
        const float vein =
            smoothStep(0.07f, 0.01f, ridge) * smoothStep(0.0f, 0.30f, fractalNoise(uv, 5, 2, 113u));
        return mix(mix(mix(green, emerald, depth), pale, cloud), dark, 0.85f * vein);
    };
    return bakeAppearance(evaluate("jade", size, 1.62f, look), settings);
}

} // namespace celadon::subedit
