#pragma once

#include "renderer/gather/sample_tree.h"
#include "tests/subedit/support/profiles.h"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace celadon::test {

inline constexpr int kMapWidth = 24;
inline constexpr int kMapHeight = 20;

using Materials = std::vector<std::shared_ptr<subedit::MaterialMap>>;

inline Materials twoMaterials() {
    Materials materials;
    for (int i = 0; i < 2; ++i) {
        materials.push_back(std::make_shared<subedit::MaterialMap>(
            subedit::test::varyingMaterial(kMapWidth, kMapHeight, 16)));
    }
    return materials;
}

inline GatherMaterials gathered(const Materials& materials) {
    const std::vector<MaterialPointer> pointers(materials.begin(), materials.end());
    return GatherMaterials(pointers);
}

/// Profiles within a rectangle fall so many times as steeply.
inline void edit(subedit::MaterialMap& map, const subedit::TexelRect& rect, float times) {
    for (int y = rect.y; y < rect.bottom(); ++y) {
        for (int x = rect.x; x < rect.right(); ++x) {
            float* const values = map.logProfile.data() + map.index(x, y, 0);
            std::for_each(values, values + std::ptrdiff_t{3} * map.knots(),
                          [times](float& value) { value = 1.0f + times * (value - 1.0f); });
        }
    }
}

inline float sheetHeight(float x) {
    return 0.01f * (x - 20.0f) * (x - 20.0f);
}

/// What a light view could see: a bent sheet, with holes, of two materials in stripes.
struct LightSheet {
    static constexpr int kSize = 40;
    std::vector<float> positions, normals, fluxes, surfaces, covariances, extents, kepts;

    LightSheet() {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        const auto put = [](std::vector<float>& to, float a, float b, float c, float d) {
            to.insert(to.end(), {a, b, c, d});
        };
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const bool isLit = unit(random) > 0.1f;
                const auto px = static_cast<float>(x);
                const auto py = static_cast<float>(y);
                put(positions, px, py, sheetHeight(px), isLit ? 50.0f : 0.0f);
                put(normals, 0.0f, 0.0f, 1.0f, 1.0f);
                put(fluxes, isLit ? 1.0f : 0.0f, isLit ? unit(random) : 0.0f, 0.0f, 0.0f);
                put(surfaces, 0.025f * px, 0.025f * py, static_cast<float>(x / 5 % 2), 3.0f);
                put(covariances, 0.1f, 0.0f, 0.0f, 0.1f);
                put(extents, 0.0f, 0.01f, 3.0f, 20.0f);
                put(kepts, 1.0f, 1.0f, 1.0f, 2.0f);
            }
        }
    }
    [[nodiscard]] LightTexels texels() const {
        return {kSize,         kSize,           positions.data(),   normals.data(),
                fluxes.data(), surfaces.data(), covariances.data(), extents.data(),
                kepts.data()};
    }
};

} // namespace celadon::test
