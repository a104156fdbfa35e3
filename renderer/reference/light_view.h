#pragma once

#include "renderer/reference/patch.h"
#include "renderer/reference/ray_scene.h"

#include <vector>

/// The finest level of the irradiance buffer (DESIGN section 3.1), made by rays through its texels'
/// centers instead of by rasterization: the patches that image-reference sums, with no GL.
namespace celadon {

/// Lit patches that one light sees.
/// Directional: parallel rays over a square of side 2R about the center of the scattering meshes'
/// bounding sphere. Point and spot: a square frustum fitted to that sphere, or, nearer than 1.15 R
/// to its center, six faces of a cube. Texels have no preferred turn about the view direction.
/// @param size  texels on a side (of each face), >= 1
[[nodiscard]] std::vector<Patch> lightViewPatches(const RayScene& rays, const Light& light,
                                                  int size);

/// The same of all lights, building the ray scene for this one use.
[[nodiscard]] std::vector<Patch> lightViewPatches(const World& world, const Light& light, int size);

} // namespace celadon
