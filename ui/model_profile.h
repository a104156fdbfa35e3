#pragma once

#include "ui/paint_state.h"

#include <glm/vec3.hpp>

#include <span>
#include <string_view>

/// Profiles by the published models (subedit/models), from what an artist has: an albedo, and how
/// far light goes.
namespace celadon::ui {

struct ModelName {
    const char* word;  ///< of commands, and of `celadon profile make`
    const char* label; ///< for people
    const char* help;
};
[[nodiscard]] std::span<const ModelName> profileModels();

/// The model's profile with this albedo and these R_P (95 %): alpha' is that of a half space which
/// returns as much light, the mean free path follows from R_P, and the albedo is then set exactly.
/// @param radiusMm each > 0
/// @throws UsageError for another word
[[nodiscard]] subedit::StoredProfile modelProfile(std::string_view model, const glm::dvec3& albedo,
                                                  const glm::dvec3& radiusMm, double eta);

} // namespace celadon::ui
