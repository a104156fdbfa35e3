#pragma once

#include "subedit/medium.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Media whose coefficients were measured, by name.
namespace celadon::subedit {

struct MediumPreset {
    std::string_view name;
    Medium medium;
    glm::dvec3 dipoleTotal; ///< total diffuse reflectance by the dipole, two decimals (a check)
    std::string_view description;
    std::string_view source = "Jensen et al. 2001"; ///< where the coefficients are from
};

/// The twelve media of Jensen, Marschner, Levoy, Hanrahan 2001, in alphabetical order.
[[nodiscard]] std::span<const MediumPreset> mediumPresets();

/// Those with `word` in their name, description or source, in any case; all for an empty word.
[[nodiscard]] std::vector<MediumPreset> searchMediumPresets(std::string_view word);

/// @throws UsageError listing the known names
[[nodiscard]] const Medium& findMediumPreset(std::string_view name);

} // namespace celadon::subedit
