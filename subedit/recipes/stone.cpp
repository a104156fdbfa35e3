#include "subedit/recipes/stone.h"

#include "subedit/recipes/appearance.h"
#include "subedit/recipes/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::subedit {

MaterialMap bakeMarbleChessboard(int size, const BakeSettings& settings) {
    constexpr int kSquares = 16;
    const Appearance ivory{{0.93f, 0.90f, 0.83f}, {12.5f, 11.0f, 9.0f}, 0.16f};
    const Appearance cream{{0.89f, 0.83f, 0.72f}, {11.0f, 9.4f, 7.4f}, 0.18f};
    const Appearance black{{0.16f, 0.115f, 0.10f}, {3.2f, 2.6f, 2.3f}, 0.14f};
    const Appearance brown{{0.27f, 0.155f, 0.11f}, {4.2f, 3.2f, 2.6f}, 0.16f};
    const auto look = [&](glm::vec2 uv) {
        const int x = static_cast<int>(uv.x * kSquares);
        const int y = static_cast<int>(uv.y * kSquares);
        // Each square is cut from another place of its block.
        const float tone = latticeRandom(x, y, 211u);
        return (x + y) % 2 == 0 ? mix(ivory, cream, tone) : mix(black, brown, tone);
    };
    return bakeAppearance(evaluate("marble chessboard", size, 1.5f, look), settings);
}

MaterialMap bakeVeinedMarble(int size, const BakeSettings& settings) {
    const Appearance white{{0.95f, 0.935f, 0.91f}, {12.0f, 10.2f, 8.6f}, 0.16f};
    const Appearance gray{{0.78f, 0.79f, 0.80f}, {9.0f, 8.0f, 7.0f}, 0.18f};
    const Appearance vein{{0.20f, 0.21f, 0.245f}, {4.0f, 3.8f, 3.7f}, 0.22f};
    const auto look = [&](glm::vec2 uv) {
        const glm::vec2 warped = uv + 0.09f * warpNoise(uv, 3, 4, 307u);
        const float cloud = smoothStep(-0.10f, 0.55f, fractalNoise(warped, 4, 3, 311u));
        // Wide faint veins, and fine dark ones that branch from them.
        const float broad = std::abs(fractalNoise(warped, 3, 4, 313u));
        const float fine = std::abs(fractalNoise(warped + glm::vec2(0.37f, 0.11f), 6, 3, 317u));
        const float where = smoothStep(-0.15f, 0.30f, fractalNoise(uv, 3, 2, 331u));
        const float halo = 0.45f * smoothStep(0.22f, 0.02f, broad);
        const float core = smoothStep(0.055f, 0.008f, broad) * (0.35f + 0.65f * where);
        const float hair = 0.75f * smoothStep(0.05f, 0.01f, fine) * where;
        const float amount = std::max({halo, core, hair});
        return mix(mix(white, gray, 0.8f * cloud), vein, 0.92f * amount);
    };
    return bakeAppearance(evaluate("veined marble", size, 1.5f, look), settings);
}

MaterialMap bakeArtificialStone(int size, const BakeSettings& settings) {
    const Appearance binder{{0.80f, 0.75f, 0.67f}, {11.5f, 10.2f, 8.8f}, 0.40f};
    // Minerals by how common they are.
    struct Mineral {
        float upTo; ///< share of the grains, cumulative
        Appearance appearance;
    };
    const std::array<Mineral, 5> minerals = {{
        {0.30f, {{0.94f, 0.93f, 0.91f}, {15.0f, 14.2f, 13.4f}, 0.30f}}, // quartz
        {0.58f, {{0.86f, 0.76f, 0.62f}, {13.0f, 10.8f, 8.6f}, 0.40f}},  // feldspar
        {0.76f, {{0.74f, 0.46f, 0.30f}, {10.5f, 6.8f, 4.8f}, 0.45f}},   // brick
        {0.90f, {{0.46f, 0.47f, 0.48f}, {8.4f, 8.2f, 8.0f}, 0.40f}},    // slate
        {1.00f, {{0.17f, 0.15f, 0.145f}, {7.5f, 6.8f, 6.4f}, 0.35f}},   // basalt
    }};
    const auto grain = [&](const CellularSample& cell, const Appearance& below, float share) {
        const auto random = static_cast<float>(cell.id >> 8) * (1.0f / 16777216.0f);
        if (random > share) {
            return below;
        }
        const float kind = random / share;
        std::size_t i = 0;
        while (i + 1 < minerals.size() && kind > minerals[i].upTo) {
            ++i;
        }
        // Grains end shortly before their cell does: binder shows between them.
        const float inside = smoothStep(0.05f, 0.16f, cell.second - cell.nearest);
        return mix(below, minerals[i].appearance, inside);
    };
    const auto look = [&](glm::vec2 uv) {
        const glm::vec2 warped = uv + 0.012f * warpNoise(uv, 16, 2, 401u);
        const Appearance fine = grain(cellularNoise(warped, 34, 409u), binder, 0.70f);
        return grain(cellularNoise(warped, 13, 419u), fine, 0.42f);
    };
    return bakeAppearance(evaluate("artificial stone", size, 1.48f, look), settings);
}

} // namespace celadon::subedit
