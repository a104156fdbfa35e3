#pragma once

#include "subedit/map/material_bake.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// What the procedural recipes share: one look per texel, and mixing of looks.
namespace celadon::subedit {

struct Appearance {
    glm::vec3 albedo;          ///< diffuse albedo, linear
    glm::vec3 effectiveRadius; ///< mm that hold 95 % of the energy, per channel
    float roughness = 0.3f;
};

/// Albedo and roughness mix linearly, radii by their logarithm.
[[nodiscard]] Appearance mix(const Appearance& a, const Appearance& b, float t);

/// A square map of look(uv) at the texel centers.
template<typename Look>
[[nodiscard]] AppearanceMap evaluate(std::string_view name, int size, float eta, const Look& look) {
    AppearanceMap map;
    map.name = name;
    map.width = map.height = size;
    map.eta = eta;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / static_cast<float>(size);
            const Appearance appearance = look(uv);
            map.albedo.push_back(appearance.albedo);
            map.effectiveRadius.push_back(appearance.effectiveRadius);
            map.roughness.push_back(appearance.roughness);
        }
    }
    return map;
}

} // namespace celadon::subedit
