#pragma once

#include "ui/session.h"

namespace celadon::ui {

/// Primary and secondary profile side by side, with their colors; a click swaps.
void drawProfilePair(Session& session);

/// Display colors (sRGB, opaque) of a homogeneous half space of this profile: lit all over, so that
/// its albedo shows.
[[nodiscard]] unsigned albedoColor(const subedit::StoredProfile& profile);

} // namespace celadon::ui
