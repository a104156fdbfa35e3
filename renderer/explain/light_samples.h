#pragma once

#include "renderer/gather/sample_tree.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

/// The samples of one light (Chen et al. 2012, section 4.2; DESIGN 3.2) for people to look at.
namespace celadon {

struct ShownSample {
    glm::vec3 positionMm{0.0f};
    float radiusMm = 0.0f; ///< that its lit texels lie within
    int level = 0;         ///< of the irradiance buffer; 0 is the finest
    glm::vec3 flux{0.0f};  ///< 1e-6 W
};

/// Those that light a point `distanceMm` away: each lit texel is in exactly one. The paper's scheme
/// has the same ones at every distance.
[[nodiscard]] std::vector<ShownSample> samplesAtDistance(const SampleTree& tree, bool hierarchical,
                                                         float distanceMm);

/// [level]: how many.
[[nodiscard]] std::vector<std::size_t> countPerLevel(const std::vector<ShownSample>& samples);

} // namespace celadon
