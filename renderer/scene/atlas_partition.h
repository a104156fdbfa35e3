#pragma once

#include "renderer/scene/atlas_flatten.h"

#include <vector>

namespace celadon::atlas {

/// The whole surface as flattened charts, few and large: regions are grown, those that do not
/// flatten within the limits are halved until they do, then neighbors are merged while the union
/// still flattens.
/// @return charts in the order of their first triangles; every triangle is in one
[[nodiscard]] std::vector<Chart> partition(const Surface& surface);

} // namespace celadon::atlas
