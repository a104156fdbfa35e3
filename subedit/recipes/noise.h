#pragma once

#include <glm/vec2.hpp>

#include <cstdint>

/// Noise over the unit square that tiles: value at u = 0 and u = 1 is the same, and so for v.
/// Seeded and computed from integer hashes only, so that a recipe gives the same material
/// everywhere.
namespace celadon::subedit {

/// A hash of a lattice point; the same everywhere.
[[nodiscard]] std::uint32_t latticeHash(int x, int y, std::uint32_t seed);

/// The above as a number in [0, 1).
[[nodiscard]] float latticeRandom(int x, int y, std::uint32_t seed);

/// Gradient noise (after Perlin 1985, 2002): about [-0.7, 0.7], mean 0.
/// @param uv    any; repeats with period 1
/// @param cells lattice cells along each side, >= 1
[[nodiscard]] float gradientNoise(glm::vec2 uv, int cells, std::uint32_t seed);

/// Octaves of gradient noise, each twice as fine and half as strong; about [-1, 1].
[[nodiscard]] float fractalNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed);

/// Two independent fractal noises, to displace coordinates with.
[[nodiscard]] glm::vec2 warpNoise(glm::vec2 uv, int cells, int octaves, std::uint32_t seed);

struct CellularSample {
    float nearest;    ///< distance to the nearest feature point, in cells
    float second;     ///< to the second nearest; second - nearest is 0 on the borders of grains
    std::uint32_t id; ///< of the nearest point's grain
};

/// Cellular noise (after Worley 1996): one feature point in each of cells x cells.
[[nodiscard]] CellularSample cellularNoise(glm::vec2 uv, int cells, std::uint32_t seed);

/// 0 at `low`, 1 at `high`, smooth between; `low` may be above `high`.
[[nodiscard]] float smoothStep(float low, float high, float x);

} // namespace celadon::subedit
