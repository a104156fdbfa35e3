#pragma once

#include "renderer/scene/atlas_dual_graph.h"

#include <vector>

namespace celadon::atlas {

/// Straightens the borders between labels by a few steps of motion by mean curvature: each label's
/// indicator is diffused over the surface, then each node takes the strongest (Merriman, Bence,
/// Osher 1992). Diffusion hardly crosses creases, so borders on creases stay. Islands that this
/// cuts off go to the label around them.
void smoothBorders(const DualGraph& graph, std::vector<int>& labels);

} // namespace celadon::atlas
