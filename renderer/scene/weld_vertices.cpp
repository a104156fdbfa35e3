#include "renderer/scene/weld_vertices.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace celadon {

std::vector<std::uint32_t> weldVertices(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const glm::vec3 p = positions[i] + 0.0f; // -0 becomes 0
        return std::array{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(key(a), a) < std::pair(key(b), b);
    });
    std::vector<std::uint32_t> group(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool isNew = i == 0 || key(order[i]) != key(order[i - 1]);
        group[order[i]] = isNew ? order[i] : group[order[i - 1]];
    }
    return group;
}

} // namespace celadon
