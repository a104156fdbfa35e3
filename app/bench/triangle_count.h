#pragma once

#include "renderer/scene/scene.h"

#include <cstddef>

/// Models with as many triangles as the paper's scenes have, from models with more or fewer.
namespace celadon::app {

/// A scene of one mesh without texture coordinates (which an atlas gives later), of `count`
/// triangles give or take one; or the scene as it is where its count is within 2 %.
///
/// Fewer: edges are collapsed by quadric error (Garland, Heckbert, "Surface simplification using
/// quadric error metrics", 1997, as OpenMesh has it); vertices of open borders stay. More: longest
/// edges are split at their middles, which keeps the surface as it is. Normals are computed anew.
/// The same model gives the same triangles on every run.
/// @param scene meshes of one look, at rest; bindings are dropped
/// @throws InputError where so few triangles cannot be had without collapsing the surface
[[nodiscard]] Scene withTriangleCount(Scene scene, std::size_t count);

} // namespace celadon::app
