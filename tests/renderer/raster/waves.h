#pragma once

#include "renderer/raster/triangle_raster.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <vector>

namespace celadon::test {

/// A wavy sheet over [-1, 1]^2, as a mesh of n x n cells.
struct Waves {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> corners;

    explicit Waves(std::uint32_t n, float height = 0.3f) {
        for (std::uint32_t y = 0; y <= n; ++y) {
            for (std::uint32_t x = 0; x <= n; ++x) {
                const glm::vec2 p = 2.0f * glm::vec2(x, y) / static_cast<float>(n) - 1.0f;
                positions.emplace_back(p, height * std::sin(5.0f * p.x) * std::cos(7.0f * p.y));
            }
        }
        for (std::uint32_t y = 0; y < n; ++y) {
            for (std::uint32_t x = 0; x < n; ++x) {
                const std::uint32_t a = y * (n + 1) + x;
                const std::uint32_t b = a + n + 1;
                corners.insert(corners.end(), {a, a + 1, b + 1, a, b + 1, b});
            }
        }
    }

    [[nodiscard]] RasterMesh mesh() const {
        RasterMesh result;
        result.vertices = &positions[0].x;
        result.vertexCount = positions.size();
        result.corners = corners;
        return result;
    }
};

} // namespace celadon::test
