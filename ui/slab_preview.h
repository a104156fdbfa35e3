#pragma once

#include "subedit/edit/edit_operator.h"

#include <glm/vec3.hpp>

/// How a plate of a homogeneous material would look, told from its profile alone: quick, and an
/// estimate.
namespace celadon::ui {

struct SlabLook {
    glm::vec3 reflected{0.0f};   ///< part of even light from the front that comes back
    glm::vec3 transmitted{0.0f}; ///< and that comes through
};

/// Kubelka 1948, "New contributions to the optics of intensely light-scattering materials", for two
/// fluxes: a plate with the reflectance of the half space R = A, and the attenuation that the tail
/// of the profile shows, P r ~ exp(-sigma r).
[[nodiscard]] SlabLook lookOfSlab(const subedit::StoredProfile& profile, float thicknessMm);

} // namespace celadon::ui
