#include "renderer/reference/spatial_order.h"

namespace celadon {

namespace {

/// Spreads the lowest 16 bits to every third bit.
std::uint64_t spreadBits(std::uint64_t v) {
    v &= 0xffff;
    v = (v | (v << 16)) & 0x0000ff0000ffULL;
    v = (v | (v << 8)) & 0x00f00f00f00fULL;
    v = (v | (v << 4)) & 0x0c30c30c30c3ULL;
    v = (v | (v << 2)) & 0x249249249249ULL;
    return v;
}

} // namespace

std::uint64_t mortonKey(glm::vec3 position, const PointBounds& bounds) {
    constexpr float kCells = 65535.0f;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = bounds.high[axis] - bounds.low[axis];
        const float unit = extent > 0.0f ? (position[axis] - bounds.low[axis]) / extent : 0.0f;
        const float cell = std::min(std::max(unit * kCells, 0.0f), kCells);
        key |= spreadBits(static_cast<std::uint64_t>(cell)) << axis;
    }
    return key;
}

} // namespace celadon
