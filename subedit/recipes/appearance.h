#pragma once

#include "subedit/map/material_bake.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string_view>

/// What the procedural recipes share: one look per texel, and mixing of looks.
namespace celadon::subedit {

struct Appearance {
    glm::vec3 albedo;          ///< diffuse albedo, linear
    glm::vec3 effectiveRadius; ///< mm that hold 95 % of the energy, per channel
    float roughness = 0.3f;
};

/// Albedo and roughness mix linearly, radii by their logarithm.
[[nodiscard]] Appearance mix(const Appearance& a, const Appearance& b, float t);

/// Mean in the same sense.
class AppearanceMean {
public:
    void add(const Appearance& appearance);
    [[nodiscard]] Appearance result() const;

private:
    Appearance mSum{glm::vec3(0.0f), glm::vec3(0.0f), 0.0f}; ///< of the logarithms of radii
    float mCount = 0.0f;
};

/// A square map of look(uv), the mean over each texel's square (16 samples).
template<typename Look>
[[nodiscard]] AppearanceMap evaluate(std::string_view name, int size, float eta, const Look& look) {
    constexpr int kSide = 4;
    AppearanceMap map;
    map.name = name;
    map.width = map.height = size;
    map.eta = eta;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            AppearanceMean mean;
            for (int sample = 0; sample < kSide * kSide; ++sample) {
                const glm::vec2 within =
                    (glm::vec2(sample % kSide, sample / kSide) + 0.5f) / static_cast<float>(kSide);
                mean.add(look((glm::vec2(x, y) + within) / static_cast<float>(size)));
            }
            const Appearance appearance = mean.result();
            map.albedo.push_back(appearance.albedo);
            map.effectiveRadius.push_back(appearance.effectiveRadius);
            map.roughness.push_back(appearance.roughness);
        }
    }
    return map;
}

} // namespace celadon::subedit
