#pragma once

#include "renderer/scene/world.h"
#include "subedit/map/material_map.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

/// Synthetic SubEdit materials: finite at r = 0, with a core and a tail as real profiles have, and
/// an albedo that is known.
namespace celadon::test {

/// P(r) = A sum of w_i e^(-r/l_i) / (2 pi l_i^2) with (w, l) = (0.4, l/3) and (0.6, l): its
/// integral over the plane is A. R_P of energy 0.95 is about 4.3 l; 10 l hold 99.97 %.
struct ProfileRecipe {
    glm::dvec3 albedo{0.8, 0.6, 0.4};
    glm::dvec3 lengthMm{1.0};
};

inline double recipeProfile(const ProfileRecipe& recipe, int channel, double r) {
    double sum = 0.0;
    for (const auto& [weight, length] : {std::pair(0.4, recipe.lengthMm[channel] / 3.0),
                                         std::pair(0.6, recipe.lengthMm[channel])}) {
        sum += weight * std::exp(-r / length) / (2.0 * std::numbers::pi * length * length);
    }
    return recipe.albedo[channel] * sum;
}

/// @param recipe what texel (x, y) holds
inline MaterialPointer makeMaterial(std::string name, int size, int segments, float maxRadiusMm,
                                    const std::function<ProfileRecipe(int, int)>& recipe) {
    auto map = std::make_shared<subedit::MaterialMap>();
    map->name = std::move(name);
    map->width = map->height = size;
    map->segments = segments;
    map->maxRadiusMm = maxRadiusMm;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const ProfileRecipe here = recipe(x, y);
            for (int k = 0; k <= segments; ++k) {
                const double r = static_cast<double>(maxRadiusMm) * k / segments;
                for (int c = 0; c < 3; ++c) {
                    map->logProfile.push_back(
                        std::max(static_cast<float>(std::log(recipeProfile(here, c, r))),
                                 subedit::kLogProfileFloor));
                }
            }
        }
    }
    return map;
}

/// One texel; red scatters furthest.
inline MaterialPointer homogeneousMaterial(double lengthMm, std::string name = "homogeneous") {
    return makeMaterial(std::move(name), 1, 64, static_cast<float>(10.0 * lengthMm), [&](int, int) {
        return ProfileRecipe{{0.8, 0.6, 0.4}, lengthMm * glm::dvec3(1.0, 0.8, 0.6)};
    });
}

/// On an object of 100 mm: R_P is about 2, 9 and 26 mm.
inline MaterialPointer shortRangeMaterial() {
    return homogeneousMaterial(0.5, "short range");
}
inline MaterialPointer mediumRangeMaterial() {
    return homogeneousMaterial(2.0, "medium range");
}
inline MaterialPointer longRangeMaterial() {
    return homogeneousMaterial(6.0, "long range");
}

/// Two materials, R_P about 4 and 13 mm, in 8 x 8 squares over the texture's unit square.
inline MaterialPointer chessboardMaterial() {
    return makeMaterial("chessboard", 32, 40, 30.0f, [](int x, int y) {
        return (x / 4 + y / 4) % 2 == 0
                   ? ProfileRecipe{{0.85, 0.75, 0.6}, glm::dvec3(3.0, 2.5, 2.0)}
                   : ProfileRecipe{{0.3, 0.5, 0.7}, glm::dvec3(0.8, 0.9, 1.0)};
    });
}

/// By the names that tests print.
inline MaterialPointer materialNamed(const std::string& name) {
    return name == "short"    ? shortRangeMaterial()
           : name == "medium" ? mediumRangeMaterial()
           : name == "long"   ? longRangeMaterial()
                              : chessboardMaterial();
}

} // namespace celadon::test
