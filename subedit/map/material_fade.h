#pragma once

#include "subedit/map/material_map.h"

/// A material that becomes another (Chen et al. 2012, Fig. 10): ln P of both, texel by texel and
/// knot by knot, is mixed linearly, as between texels of one map.
namespace celadon::subedit {

class MaterialFade {
public:
    /// Brings both to one layout: the larger size and r_s, and knots as close as the closer of
    /// both has them. Each keeps its albedo (convertMaterial).
    MaterialFade(MaterialMap from, MaterialMap to);

    /// @param t 0: the first as it was given, 1: the second; clamped
    [[nodiscard]] MaterialMap at(double t) const;

private:
    MaterialMap mFirst, mSecond; ///< as they were given
    MaterialMap mFirstLaidOut, mSecondLaidOut;
};

} // namespace celadon::subedit
