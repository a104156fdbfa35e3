#pragma once

#include "subedit/map/material_map.h"
#include "subedit/paint/surface.h"

#include <span>

/// Profiles as points of a space of few dimensions in which Euclidean distance is about D of
/// profile_distance.h: D is the distance between the functions sqrt(P), which a quadrature turns
/// into vectors and a principal component analysis over the map shortens.
namespace celadon::subedit {

inline constexpr int kProfileFeatures = 8;

/// @param texels  whose features are wanted
/// @param scale   of the features, such as 1 / tolerance
/// @param out     row i, `stride` floats apart, gets the kProfileFeatures of texels[i]
void profileFeatures(const MaterialMap& map, std::span<const Surface::Texel> texels, float scale,
                     float* out, int stride);

} // namespace celadon::subedit
