#pragma once

#include "renderer/scene/world.h"
#include "subedit/paint/surface_atlas.h"

/// From a world's texture coordinates to the surface that painting in space works on.
namespace celadon {

/// World position (mm) and interpolated normal at the center of every texel, of the meshes that
/// wear material `material` (index into World::materials). Coordinates outside [0, 1] repeat.
/// Charts are pieces of mesh that share vertices. Where several triangles cover a texel the first
/// one has it, and the texel counts as an overlap.
/// @param width, height of the material's map, texels
[[nodiscard]] subedit::SurfaceAtlas makeSurfaceAtlas(const World& world, int material, int width,
                                                     int height);

} // namespace celadon
