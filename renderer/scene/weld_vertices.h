#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace celadon {

/// Numbers vertices such that those at one position share a number: that of the first of them.
[[nodiscard]] std::vector<std::uint32_t> weldVertices(std::span<const glm::vec3> positions);

} // namespace celadon
