#pragma once

#include "subedit/map/material_map.h"
#include "subedit/map/texel_rect.h"

#include <vector>

/// What the splatting passes look up of a material besides ln P: radii, kept energy, far energy,
/// and the range table. Computed on the CPU when a material changes, in single precision. No GL
/// here.
namespace celadon {

/// The tables of a rectangle of the map, whose width and height these are.
struct TexelTables {
    /// [height][width][4]: R_P (energy 0.95, longest channel), R_cut, R_P of the shortest channel,
    /// 0; mm
    std::vector<float> radii;
    /// [height][width][4]: fraction of each channel's energy inside R_cut, 1
    std::vector<float> kept;
    /// [height][width][segments + 1][3]: ln of the integral of sqrt(P_x Pbar) r dr over [r_k, r_s],
    /// Pbar the exponential of the mean ln P over the map; what the accumulation divides out.
    std::vector<float> logFarEnergy;
};

/// What takes all texels of a map to know.
struct MaterialTables {
    /// Pbar of TexelTables::logFarEnergy: [segments + 1][3] means of ln P.
    std::vector<float> meanLogProfile;
    /// Rbar over log2 T in [0, 12], equally spaced (DESIGN 3.3, eq. 14).
    std::vector<float> rangeTable;
    float meanRadiusMm = 0.0f;  ///< mean R_P over the texels
    float shortRadiusMm = 0.0f; ///< R_P that a quarter of the texels fall below
};

/// @param epsilon of eq. 14
[[nodiscard]] MaterialTables makeMaterialTables(const subedit::MaterialMap& map, double epsilon);

/// @param energy fraction that R_cut holds; 1: R_cut = r_s, everything is kept
/// @param meanLogProfile any that all texels agree on: the one that the first were made with
[[nodiscard]] TexelTables makeTexelTables(const subedit::MaterialMap& map,
                                          const subedit::TexelRect& rect, double energy,
                                          const std::vector<float>& meanLogProfile);

} // namespace celadon
