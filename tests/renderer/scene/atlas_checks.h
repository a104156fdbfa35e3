#pragma once

#include "renderer/scene/atlas.h"

/// What must hold for every atlas, found out without the atlas's own code.
namespace celadon::test {

/// Arrays fit the input, coordinates are finite and in [0, 1], every new vertex stands for the
/// right old one, charts are numbered within the report.
void expectWellFormed(std::span<const Mesh* const> meshes, const Atlas& atlas);

/// Every triangle of sensible shape keeps its orientation, none of them mirrored.
void expectOriented(std::span<const Mesh* const> meshes, const Atlas& atlas);

/// No point of a grid of `resolution` points on a side lies inside two triangles.
void expectNoOverlap(std::span<const Mesh* const> meshes, const Atlas& atlas, int resolution);

/// At `resolution`, texels touched by different charts are more than `gutter` apart, and as far
/// from the border.
void expectGutter(std::span<const Mesh* const> meshes, const Atlas& atlas, int resolution,
                  int gutter);

/// Small enough to be quick without optimization.
inline constexpr AtlasSettings kSmallMap{512, 4};

/// All of the above; overlap is looked for at twice the resolution.
Atlas expectGoodAtlas(std::span<const Mesh* const> meshes,
                      const AtlasSettings& settings = kSmallMap);
Atlas expectGoodAtlas(const Mesh& mesh, const AtlasSettings& settings = kSmallMap);

[[nodiscard]] bool sameBytes(const Atlas& a, const Atlas& b);

} // namespace celadon::test
