#pragma once

#include "subedit/medium.h"

#include <span>
#include <string>
#include <string_view>

/// Media whose coefficients were measured, by name.
namespace celadon::subedit {

struct MediumPreset {
    std::string_view name;
    Medium medium;
    glm::dvec3 dipoleTotal; ///< total diffuse reflectance by the dipole, two decimals (a check)
};

/// The twelve media of Jensen, Marschner, Levoy, Hanrahan 2001, in alphabetical order.
[[nodiscard]] std::span<const MediumPreset> mediumPresets();

/// @throws UsageError listing the known names
[[nodiscard]] const Medium& findMediumPreset(std::string_view name);

} // namespace celadon::subedit
