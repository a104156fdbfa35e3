#pragma once

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace celadon {

/// A tube along y from 0 to 100, radius 10, open at both ends.
inline Mesh tube(int around, int along, const glm::vec3& offset = glm::vec3(0.0f)) {
    Mesh mesh;
    for (int j = 0; j <= along; ++j) {
        for (int i = 0; i < around; ++i) {
            const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) /
                                static_cast<float>(around);
            const glm::vec3 n(std::cos(angle), 0.0f, std::sin(angle));
            mesh.positions.push_back(
                offset + 10.0f * n +
                glm::vec3(0, 100.0f * static_cast<float>(j) / static_cast<float>(along), 0));
            mesh.normals.push_back(n);
            mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(around),
                                  static_cast<float>(j) / static_cast<float>(along));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(j * around + i % around);
    };
    for (int j = 0; j < along; ++j) {
        for (int i = 0; i < around; ++i) {
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i, j + 1), at(i + 1, j),
                                                     at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    }
    return mesh;
}

} // namespace celadon
