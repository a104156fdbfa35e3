#pragma once

#include "subedit/map/material_bake.h"

#include <span>
#include <string_view>

/// The materials that ship with Celadon, each a pure function of its size: `celadon material bake
/// --recipe NAME` writes them. Ranges suit an object of some 100 mm.
namespace celadon::subedit {

struct Recipe {
    std::string_view name;
    std::string_view description;
    int size; ///< texels a side it is shipped with; 1 is homogeneous
    MaterialMap (*bake)(int size, const BakeSettings& settings);
    int segments; ///< it is shipped with
};

/// In alphabetical order.
[[nodiscard]] std::span<const Recipe> recipes();

/// @throws UsageError listing the known names
[[nodiscard]] const Recipe& findRecipe(std::string_view name);

} // namespace celadon::subedit
