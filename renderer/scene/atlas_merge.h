#pragma once

#include "renderer/scene/atlas_flatten.h"

#include <vector>

namespace celadon::atlas {

/// Joins neighboring charts, those with the longest common border for their size first, as long as
/// the union flattens within the limits and stays compact.
void mergeCharts(const Surface& surface, std::vector<Chart>& charts);

} // namespace celadon::atlas
