#pragma once

#include "renderer/scene/scene.h"

/// The builtin models one by one; builtin.h finds them by name. All are closed, in millimeters.
namespace celadon {

/// Diameter 100 mm; latitude-longitude texture coordinates, u around y, v from the top down.
[[nodiscard]] Scene makeSphere();

/// 100 x 20 x 100 mm; the six faces side by side in the texture at one scale.
[[nodiscard]] Scene makeSlab();

} // namespace celadon
