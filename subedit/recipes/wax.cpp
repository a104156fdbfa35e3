#include "subedit/recipes/wax.h"

#include "subedit/recipes/appearance.h"
#include "subedit/recipes/noise.h"

#include <cmath>

namespace celadon::subedit {

MaterialMap bakeYellowWax(int size, const BakeSettings& settings) {
    const Appearance clear{{0.91f, 0.68f, 0.22f}, {15.0f, 10.5f, 5.0f}, 0.32f};
    const Appearance dense{{0.84f, 0.52f, 0.12f}, {11.0f, 7.0f, 3.4f}, 0.36f};
    const Appearance vein{{0.46f, 0.17f, 0.035f}, {6.0f, 3.8f, 2.2f}, 0.40f};
    const auto look = [&](glm::vec2 uv) {
        const glm::vec2 warped = uv + 0.045f * warpNoise(uv, 4, 3, 11u);
        const float cloud = smoothStep(-0.35f, 0.45f, fractalNoise(warped, 5, 3, 23u));
        // Veins run where a noise crosses zero; a second noise lets them thin out and end.
        const float ridge = std::abs(fractalNoise(warped, 6, 3, 37u));
        const float width = 0.10f * smoothStep(-0.25f, 0.35f, fractalNoise(uv, 4, 2, 41u));
        const float veins =
            smoothStep(width + 0.02f, 0.3f * width, ridge) * smoothStep(0.0f, 0.03f, width);
        return mix(mix(clear, dense, cloud), vein, veins);
    };
    return bakeAppearance(evaluate("yellow wax", size, 1.44f, look), settings);
}

MaterialMap bakeBlueWax(int size, const BakeSettings& settings) {
    const Appearance clear{{0.16f, 0.42f, 0.90f}, {6.5f, 10.5f, 17.5f}, 0.28f};
    const Appearance milky{{0.42f, 0.66f, 0.93f}, {4.4f, 5.6f, 7.5f}, 0.34f};
    const Appearance deep{{0.05f, 0.14f, 0.52f}, {2.2f, 2.8f, 4.2f}, 0.30f};
    const auto look = [&](glm::vec2 uv) {
        // Swirls: noise of noise, as two waxes poured into one another.
        const glm::vec2 swirl =
            uv + 0.16f * warpNoise(uv + 0.05f * warpNoise(uv, 6, 2, 3u), 3, 3, 5u);
        const float milk = smoothStep(-0.05f, 0.40f, fractalNoise(swirl, 4, 3, 13u));
        const float streak = smoothStep(0.085f, 0.02f, std::abs(fractalNoise(swirl, 4, 2, 29u))) *
                             smoothStep(0.05f, 0.35f, fractalNoise(uv, 4, 2, 31u) + 0.1f);
        return mix(mix(clear, milky, milk), deep, streak);
    };
    return bakeAppearance(evaluate("blue wax", size, 1.44f, look), settings);
}

} // namespace celadon::subedit
