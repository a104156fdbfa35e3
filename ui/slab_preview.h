#pragma once

#include "subedit/edit/edit_operator.h"

#include <glm/vec3.hpp>

/// How a plate of a homogeneous material would look, told from its profile alone: quick, and an
/// estimate.
namespace celadon::ui {

struct SlabLook {
    glm::vec3 reflected{0.0f};   ///< linear display color, lit evenly from the front
    glm::vec3 transmitted{0.0f}; ///< the same from behind, eight times brighter
};

/// A half space of this material sends back A of the light. In a plate of thickness d what would
/// have come back from deeper than d leaves through the other side instead. Light that returns at
/// a distance r has been about as deep as r / 2 (the banana of diffuse light), so of the returned
/// light the part beyond r = 2 d is missing in front, and of it half comes out behind, colored once
/// more by the way it still has to go.
[[nodiscard]] SlabLook lookOfSlab(const subedit::StoredProfile& profile, float thicknessMm);

} // namespace celadon::ui
