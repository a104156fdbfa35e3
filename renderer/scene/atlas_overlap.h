#pragma once

#include "renderer/scene/atlas_rest_shape.h"

namespace celadon::atlas {

/// Whether a flattened chart whose triangles are all positively oriented covers any point twice.
/// That is so exactly when its borders cross, or do not run around its inside once (degree of the
/// map), so only borders are looked at.
[[nodiscard]] bool overlapsItself(const ChartMesh& mesh, const Planar& uv);

} // namespace celadon::atlas
