#pragma once

#include "renderer/scene/atlas_dual_graph.h"

#include <vector>

/// Cuts a surface into compact regions of similar orientation.
namespace celadon::atlas {

/// Regions are grown from seeds by shortest paths whose length counts more the more a triangle
/// turns away from the region's mean normal, then seeds move to the centers and growth starts again
/// (Lloyd's iteration; Sander et al. 2003, "Multi-chart geometry images", section 3.1). Seeds are
/// set where the path to the nearest one is longest, until none is longer than `reach`.
/// @return a label per node, from 0; each label's nodes are connected
[[nodiscard]] std::vector<int> segment(const DualGraph& graph, double reach);

/// The same with two seeds as far apart as can be; two or more labels (what straightening the
/// border leaves apart) if the graph has two or more nodes.
[[nodiscard]] std::vector<int> bisect(const DualGraph& graph);

} // namespace celadon::atlas
