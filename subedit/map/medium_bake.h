#pragma once

#include "subedit/map/material_bake.h"

/// From maps of optical coefficients to a SubEdit material.
namespace celadon::subedit {

/// sigma_a and sigma_s' of every texel, one index of refraction.
struct MediumMap {
    int width = 0;
    int height = 0;
    float eta = 1.4f;
    std::vector<glm::vec3> absorption;        ///< sigma_a, 1/mm, [height][width], each >= 0
    std::vector<glm::vec3> reducedScattering; ///< sigma_s', 1/mm, each > 0
    std::vector<float> roughness;             ///< [height][width] or empty
};

/// Each texel gets the shape of photon beam diffusion (models/photon_beam.h), which follows random
/// walks most closely, and exactly the albedo of the half space (models/half_space.h). Profiles
/// come from a table over alpha', scaled by each texel's mean free path.
[[nodiscard]] MaterialMap bakeMedia(const MediumMap& media, const BakeSettings& settings = {});

} // namespace celadon::subedit
