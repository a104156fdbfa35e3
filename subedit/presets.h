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
    std::string_view description;
    std::string_view source; ///< where the coefficients are from
    /// Mean cosine g per channel where it was measured, else 0. The medium's own `anisotropy` is 0:
    /// by similarity sigma_s' is all that a diffuse profile depends on.
    glm::dvec3 measuredAnisotropy{0.0};
};

/// Twelve media of Jensen et al. 2001 and fifteen of Narasimhan et al. 2006, in alphabetical order.
[[nodiscard]] std::span<const MediumPreset> mediumPresets();

/// Those with `word` in their name, description or source, in any case; all for an empty word.
[[nodiscard]] std::vector<MediumPreset> searchMediumPresets(std::string_view word);

/// @throws UsageError listing the known names
[[nodiscard]] const Medium& findMediumPreset(std::string_view name);

} // namespace celadon::subedit
