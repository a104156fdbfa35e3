#pragma once

#include "renderer/gather/far_energies.h"
#include "renderer/gather/view_level.h"

#include <span>
#include <vector>

/// Step 4 on the processor (Chen et al. 2012, eq. 17; DESIGN 3.4): what shaders/far_light.comp,
/// far_light_sharpening.comp, accumulation.comp and accumulation_rough.comp say, to the same
/// numbers.
namespace celadon {

struct AccumulationSettings {
    bool sharpens = true;      ///< interpolation is cubic: the hierarchical scheme
    float pixelScale = 0.0f;   ///< a pixel of level 0 is so wide at depth 1, mm,
    float pixelOffset = 0.0f;  ///<   and so much wider at any
    float objectRadius = 0.0f; ///< of the sphere about what scatters, mm
};

class LevelAccumulation {
public:
    /// B^k += upsampled B^(k+1), from coarse to fine, in place; level 0 then has the exitance.
    /// @param energies radius k is where level k's ring begins, mm; radius 0 is 0 mm
    void accumulate(std::span<ViewLevel> levels, const FarEnergies::Selection& energies,
                    const AccumulationSettings& settings);

private:
    std::vector<float> mLight, mSharpened; ///< of one level: R, G, B, R_P in mm
};

} // namespace celadon
