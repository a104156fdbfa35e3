#pragma once

#include "ui/session.h"

#include <array>
#include <vector>

/// Control points and handles of the chosen deformer, as the viewport shows and drags them: where
/// all that follows puts them, handles also where the animation carries them.
namespace celadon::ui {

struct DeformControl {
    int index = 0; ///< Lattice::index, or number of the handle
    glm::dvec3 shownMm{0.0};
};

/// Empty: none is chosen, or it has no controls.
[[nodiscard]] std::vector<DeformControl> shownControls(const Session& session);

/// Pairs of controls that a line joins: neighbors of the grid.
[[nodiscard]] std::vector<std::array<int, 2>> controlLines(const Session& session);

/// Moves a control such that it is seen to move by so much.
/// @param index of one of shownControls()
[[nodiscard]] Command dragControl(const Session& session, int index, const glm::dvec3& deltaMm);

} // namespace celadon::ui
