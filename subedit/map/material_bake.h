#pragma once

#include "subedit/map/material_map.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

/// From maps of appearance (what an artist can say: color and range) to a SubEdit material.
namespace celadon::subedit {

/// Albedo and range of every texel; profiles get the shape of normalized diffusion
/// (models/normalized_diffusion.h), the same at all ranges.
struct AppearanceMap {
    std::string name;
    int width = 0;
    int height = 0;
    float eta = 1.4f;
    std::vector<glm::vec3> albedo;          ///< diffuse albedo, [height][width], each in [0, 1]
    std::vector<glm::vec3> effectiveRadius; ///< mm that hold 95 % of the energy, per channel, > 0
    std::vector<float> roughness;           ///< [height][width] or empty
};

struct BakeSettings {
    int segments = 24;
    double maxRadiusMm = 0.0;  ///< r_s; 0 takes what holds `heldEnergy` of the longest profile
    double heldEnergy = 0.999; ///< of the longest profile of the map
};

/// Every texel keeps its albedo exactly (up to single precision), whatever the segments resolve.
[[nodiscard]] MaterialMap bakeAppearance(const AppearanceMap& appearance,
                                         const BakeSettings& settings = {});

/// Effective radius (95 %) of normalized diffusion with this albedo and mean free path 1/sigma_t',
/// by its searchlight fit. All in mm, per channel.
[[nodiscard]] glm::vec3 effectiveRadiusFromMeanFreePath(const glm::vec3& albedo,
                                                        const glm::vec3& meanFreePathMm);

} // namespace celadon::subedit
