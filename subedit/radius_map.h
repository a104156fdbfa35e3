#pragma once

#include "subedit/effective_radius.h"
#include "subedit/map/material_map.h"
#include "subedit/map/texel_rect.h"

#include <span>
#include <vector>

/// Effective radii and albedos of every texel of a material, fast: single precision, vectorized and
/// on all cores; agrees with effective_radius.h to 1e-4. DESIGN 3.3 takes two radii of each texel,
/// R_P (energy 0.95) for selection and rings, R_cut for the end of the splat.
namespace celadon::subedit {

/// The profile of texel (x, y); valid as long as the map's storage.
[[nodiscard]] inline ProfileView profileAt(const MaterialMap& map, int x, int y) {
    return {map.logProfile.data() + map.index(x, y, 0), map.segments, map.maxRadiusMm};
}

/// Radius in mm that holds the fraction of each texel's energy, the largest of the channels. Never
/// zero: a texel that is black in all channels gets r_s / 1000.
/// @param energyFraction in (0, 1]; 1 gives r_s
/// @return               [height][width]
[[nodiscard]] std::vector<float> effectiveRadiusMap(const MaterialMap& map,
                                                    double energyFraction = 0.95);

/// The texels of `rect` of an effectiveRadiusMap(), anew: the same bits as the whole map would get.
/// On the calling thread: from several at once, with rectangles that do not meet.
/// @param radiusMm [height][width], as effectiveRadiusMap() returned it
void updateEffectiveRadii(const MaterialMap& map, const TexelRect& rect, double energyFraction,
                          std::span<float> radiusMm);

/// Diffuse albedo of every texel, [height][width][3].
[[nodiscard]] std::vector<float> albedoMap(const MaterialMap& map);

/// What part of each texel's energy lies in its last segment, the largest of the channels; 0 where
/// it is black. Much there says that the profile was cut at r_s. [height][width]
[[nodiscard]] std::vector<float> lastSegmentMap(const MaterialMap& map);

} // namespace celadon::subedit
