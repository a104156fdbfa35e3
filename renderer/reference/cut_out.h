#pragma once

#include "renderer/reference/ray_scene.h"

/// Holes that the alpha of a base color cuts into a mesh (SurfaceMaterial::alphaCutoff), for rays.
/// The GPU decides the same in shaders/include/surface.glsl: by the picture's finest level,
/// filtered as its sampler says.
namespace celadon {

/// Whether some place of the mesh may be cut out.
[[nodiscard]] bool mayBeCutOut(const World& world, const Mesh& mesh);

/// Whether there is no surface at that place.
[[nodiscard]] bool isCutOut(const World& world, const TrianglePoint& place);

} // namespace celadon
