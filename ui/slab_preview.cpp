#include "ui/slab_preview.h"

#include "subedit/effective_radius.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon::ui {

SlabLook lookOfSlab(const subedit::StoredProfile& profile, float thicknessMm) {
    constexpr double kBrighter = 8.0; // three stops
    const double reach = 2.0 * static_cast<double>(thicknessMm);
    const glm::dvec3 albedo = subedit::diffuseAlbedo(profile.view());
    const double inside = std::min(reach, static_cast<double>(profile.maxRadiusMm));
    const glm::dvec3 near = 2.0 * std::numbers::pi * subedit::radialEnergy(profile.view(), inside);
    const glm::dvec3 beyond = glm::max(albedo - near, glm::dvec3(0.0));
    SlabLook look;
    look.reflected = glm::vec3(glm::min(near, glm::dvec3(1.0)));
    look.transmitted = glm::vec3(glm::min(kBrighter * 0.5 * beyond, glm::dvec3(1.0)));
    return look;
}

} // namespace celadon::ui
