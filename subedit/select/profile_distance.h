#pragma once

#include "subedit/edit/profile_editor.h"

/// How different two profiles are. With the diffuse scattering function sqrt(P Q) of eq. 8 (Chen et
/// al. 2012), the distance D is, squared and averaged over the channels,
///     D^2 = A_P / 2 + A_Q / 2 - 2 pi integral of sqrt(P Q) r dr
///         = 1/2 * 2 pi integral of (sqrt P - sqrt Q)^2 r dr:
/// the energy by which scattering between the two falls short of scattering within each. It is a
/// metric (the Hellinger distance of energy densities): 0 for equal profiles only, 1 for two of
/// albedo 1 that share nothing; albedo, range and shape all count as much as light sees them.
namespace celadon::subedit {

/// One profile against many. Not small: holds the working memory of a TexelEnergy.
class ProfileDistance {
public:
    /// @param reference knots x 3 values of ln P; copied
    ProfileDistance(const float* reference, const ProfileLayout& layout);

    /// D in [0, 1] (more for profiles of albedo above 1), to some 1e-3 near 0.
    [[nodiscard]] float operator()(const float* logProfile);

private:
    ProfileLayout mLayout;
    TexelEnergy mEnergy;
    std::vector<float> mReference;
    std::vector<float> mMean;
    float mReferenceAlbedo = 0.0f; ///< sum of the channels
};

} // namespace celadon::subedit
