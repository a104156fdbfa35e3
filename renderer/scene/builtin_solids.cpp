// The two plain solids, sphere and slab: builtin_shapes.h.
#include "renderer/scene/builtin_shapes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace celadon {

namespace {

Scene sceneOf(Mesh mesh) {
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.millimetersPerUnit = 1.0;
    return scene;
}

} // namespace

Scene makeSphere() {
    constexpr double kRadius = 50.0;
    constexpr int kColumns = 144;
    constexpr int kRows = 72;
    Mesh mesh;
    mesh.name = "sphere";
    // A column of vertices more than of quads, for the seam; at the poles one vertex a triangle,
    // each with the u of its triangle's middle.
    const auto add = [&](double column, int row) {
        const double phi = glm::two_pi<double>() * std::fmod(column, kColumns) / kColumns;
        const double theta = glm::pi<double>() * row / kRows;
        const double ring = row == 0 || row == kRows ? 0.0 : std::sin(theta);
        const glm::dvec3 normal(ring * std::sin(phi), row == kRows ? -1.0 : std::cos(theta),
                                ring * std::cos(phi));
        mesh.positions.emplace_back(kRadius * normal);
        mesh.normals.emplace_back(normal);
        mesh.uvs.emplace_back(column / kColumns, static_cast<double>(row) / kRows);
    };
    constexpr std::uint32_t kStride = kColumns + 1;
    for (int row = 1; row < kRows; ++row) {
        for (int column = 0; column <= kColumns; ++column) {
            add(column, row);
        }
    }
    for (std::uint32_t row = 0; row + 2 < kRows; ++row) {
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            const std::uint32_t a = row * kStride + column;
            const std::uint32_t below = a + kStride;
            mesh.indices.insert(mesh.indices.end(), {a, below, below + 1, a, below + 1, a + 1});
        }
    }
    for (std::uint32_t column = 0; column < kColumns; ++column) {
        const std::uint32_t last = (kRows - 2) * kStride + column;
        const auto north = static_cast<std::uint32_t>(mesh.positions.size());
        add(column + 0.5, 0);
        add(column + 0.5, kRows);
        mesh.indices.insert(mesh.indices.end(),
                            {north, column, column + 1, north + 1, last + 1, last});
    }
    return sceneOf(std::move(mesh));
}

Scene makeSlab() {
    constexpr glm::dvec3 kHalf(50.0, 10.0, 50.0);
    constexpr double kCell = 1.25; // mm
    // Charts at one scale: the two large faces above, the four sides as rows below them.
    constexpr double kMargin = 2.0;                         // mm between charts
    constexpr double kExtent = 2.0 * 100.0 + 3.0 * kMargin; // mm that the unit square spans
    struct Face {
        glm::dvec3 right, down; // in the face's picture; right x down points inwards
        glm::dvec2 corner;      // top left of its chart, mm
    };
    constexpr double kSecond = 100.0 + 2.0 * kMargin;
    const std::array<Face, 6> faces{{
        {{1, 0, 0}, {0, 0, 1}, {kMargin, kMargin}},                    // +y
        {{1, 0, 0}, {0, 0, -1}, {kSecond, kMargin}},                   // -y
        {{1, 0, 0}, {0, -1, 0}, {kMargin, kSecond}},                   // +z
        {{-1, 0, 0}, {0, -1, 0}, {kSecond, kSecond}},                  // -z
        {{0, 0, -1}, {0, -1, 0}, {kMargin, kSecond + 20.0 + kMargin}}, // +x
        {{0, 0, 1}, {0, -1, 0}, {kSecond, kSecond + 20.0 + kMargin}},  // -x
    }};
    Mesh mesh;
    mesh.name = "slab";
    for (const Face& face : faces) {
        const glm::dvec3 normal = -glm::cross(face.right, face.down);
        const double width = 2.0 * glm::dot(glm::abs(face.right), kHalf);
        const double height = 2.0 * glm::dot(glm::abs(face.down), kHalf);
        const auto columns = static_cast<std::uint32_t>(std::lround(width / kCell));
        const auto rows = static_cast<std::uint32_t>(std::lround(height / kCell));
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t j = 0; j <= rows; ++j) {
            for (std::uint32_t i = 0; i <= columns; ++i) {
                const glm::dvec2 p(width * i / columns, height * j / rows);
                const glm::dvec3 position = normal * kHalf + face.right * (p.x - 0.5 * width) +
                                            face.down * (p.y - 0.5 * height);
                mesh.positions.emplace_back(position);
                mesh.normals.emplace_back(normal);
                mesh.uvs.emplace_back((face.corner + p) / kExtent);
            }
        }
        for (std::uint32_t j = 0; j < rows; ++j) {
            for (std::uint32_t i = 0; i < columns; ++i) {
                const std::uint32_t a = base + j * (columns + 1) + i;
                const std::uint32_t below = a + columns + 1;
                mesh.indices.insert(mesh.indices.end(), {a, below, below + 1, a, below + 1, a + 1});
            }
        }
    }
    return sceneOf(std::move(mesh));
}

} // namespace celadon
