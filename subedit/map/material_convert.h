#pragma once

#include "subedit/map/material_map.h"

/// The same material in another size or resolution of its profiles.
namespace celadon::subedit {

struct ConvertSettings {
    int width = 0;            ///< texels; 0 keeps
    int height = 0;           ///< texels; 0 keeps
    int segments = 0;         ///< 0 keeps
    double maxRadiusMm = 0.0; ///< r_s; 0 keeps
};

/// Another size is resizeMaterial(). Other segments and another r_s fit each profile anew and keep
/// its albedo: a smaller r_s gives the energy beyond it back, nearer.
[[nodiscard]] MaterialMap convertMaterial(const MaterialMap& map, const ConvertSettings& settings);

} // namespace celadon::subedit
