#pragma once

#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"
#include "renderer/splatting/irradiance_buffer.h"

/// Step 1, light side, material: the profile of every node above level 0 as the mean of sqrt(P)
/// over its footprint, and the radii that follow (DESIGN 3.1). Not needed for a homogeneous
/// material.
namespace celadon {

class NodeProfiles {
public:
    /// @param segments of the common knots, r_s in the solve block
    NodeProfiles(const gl::ShaderLibrary& shaders, const IrradianceBuffer& buffer,
                 int materialCount, int segments);

    /// After IrradianceBuffer::buildMips; overwrites R_P, R_cut and kept energy of its nodes.
    /// @param cutEnergy fraction that R_cut holds
    void build(const IrradianceBuffer& buffer, float cutEnergy);

    /// RGBA32F array (drivers that cut off halves instead of rounding them would raise P by 0.3 %):
    /// ln P at knot = layer; mip 0 belongs to level 1 of the buffer.
    [[nodiscard]] const gl::Texture& profiles() const { return mProfiles; }

private:
    int mKnots;
    gl::Texture mProfiles;
    gl::Program mProfile, mRadii;
};

} // namespace celadon
