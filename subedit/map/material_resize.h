#pragma once

#include "subedit/map/material_map.h"
#include "subedit/map/texel_rect.h"

/// The same material by another number of texels.
namespace celadon::subedit {

/// Larger maps interpolate ln P as rendering does; smaller ones take the mean of P over each
/// texel's footprint. Either way a texel's albedo is the mean (or the interpolation) of the albedos
/// it comes from.
/// @param width, height texels, > 0
[[nodiscard]] MaterialMap resizeMaterial(const MaterialMap& map, int width, int height);

/// Makes anew the texels of a smaller map whose footprints a rectangle of the larger one touches:
/// the same as resizeMaterial() of all of it.
/// @param rect texels of `map` whose profiles have changed, not empty
/// @param smaller resizeMaterial() of `map` as it was; no side longer than the map's
/// @return the texels that were made anew
TexelRect updateSmaller(const MaterialMap& map, const TexelRect& rect, MaterialMap& smaller);

} // namespace celadon::subedit
