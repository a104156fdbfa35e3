#pragma once

#include <cstdint>

/// Z-order of texels: the children of a quadtree node are neighbors in it (Morton 1966).
namespace celadon {

[[nodiscard]] inline std::uint32_t spreadBits(std::uint32_t x) {
    x &= 0xffffu;
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

[[nodiscard]] inline std::uint32_t compactBits(std::uint32_t x) {
    x &= 0x55555555u;
    x = (x | (x >> 1)) & 0x33333333u;
    x = (x | (x >> 2)) & 0x0f0f0f0fu;
    x = (x | (x >> 4)) & 0x00ff00ffu;
    return (x | (x >> 8)) & 0xffffu;
}

[[nodiscard]] inline std::uint32_t mortonCode(std::uint32_t x, std::uint32_t y) {
    return spreadBits(x) | (spreadBits(y) << 1);
}

} // namespace celadon
