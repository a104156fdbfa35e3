#pragma once

#include "renderer/scene/world.h"

/// The automatic atlas where a world needs one; apart from world.cpp, so that what never meets a
/// mesh without texture coordinates need not carry it.
namespace celadon {

/// Gives the scattering meshes that have no uvs one atlas together (atlas.h), and says in
/// `warnings` where it stretches.
/// @throws InputError as generateAtlas
void addMissingUvs(World& world);

} // namespace celadon
