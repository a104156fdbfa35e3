#include "renderer/scene/surface_builder.h"

#include "subedit/assert.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace celadon {

namespace {

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        std::size_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // Adding zero makes -0 and 0 one, as the comparison has it.
            hash = hash * 0x9E3779B97F4A7C15u + std::bit_cast<std::uint32_t>(p[axis] + 0.0f);
            hash ^= hash >> 29;
        }
        return hash;
    }
};

/// For each vertex the number of its position.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
    std::unordered_map<glm::vec3, std::uint32_t, PositionHash> seen;
    seen.reserve(positions.size());
    std::vector<std::uint32_t> welded;
    welded.reserve(positions.size());
    for (const glm::vec3& position : positions) {
        const auto next = static_cast<std::uint32_t>(seen.size());
        welded.push_back(seen.try_emplace(position, next).first->second);
    }
    return welded;
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

std::uint32_t SurfaceBuilder::add(const SurfacePoint& point) {
    mPoints.push_back(point);
    return static_cast<std::uint32_t>(mPoints.size() - 1);
}

void SurfaceBuilder::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mIndices.insert(mIndices.end(), {a, b, c});
}

void SurfaceBuilder::addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto distance = [&](std::uint32_t i, std::uint32_t j) {
        return glm::distance(mPoints[i].position, mPoints[j].position);
    };
    // A little less for one diagonal, so that regular grids do not flicker between the two.
    if (distance(a, c) <= 1.0001 * distance(b, d)) {
        addTriangle(a, b, c);
        addTriangle(a, c, d);
    } else {
        addTriangle(a, b, d);
        addTriangle(b, c, d);
    }
}

void SurfaceBuilder::addGrid(int columns, int rows,
                             const std::function<SurfacePoint(int column, int row)>& point) {
    const auto base = static_cast<std::uint32_t>(mPoints.size());
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            add(point(column, row));
        }
    }
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column) {
            const std::uint32_t a = base + row * stride + column;
            addQuad(a, a + stride, a + stride + 1, a + 1);
        }
    }
}

void SurfaceBuilder::addHalving(const std::vector<std::uint32_t>& upper,
                                const std::vector<std::uint32_t>& lower) {
    CELADON_ASSERT(upper.size() == 2 * lower.size() - 1);
    for (std::size_t i = 0; i + 1 < lower.size(); ++i) {
        const std::uint32_t middle = upper[2 * i + 1];
        addTriangle(upper[2 * i], lower[i], middle);
        addTriangle(middle, lower[i], lower[i + 1]);
        addTriangle(middle, lower[i + 1], upper[2 * i + 2]);
    }
}

Scene SurfaceBuilder::finish(const std::string& name, double chartSideMm) const {
    Mesh mesh;
    mesh.name = name;
    mesh.positions.reserve(mPoints.size());
    mesh.uvs.reserve(mPoints.size());
    for (const SurfacePoint& point : mPoints) {
        mesh.positions.emplace_back(point.position);
        mesh.uvs.emplace_back(point.chart / chartSideMm);
    }
    const std::vector<std::uint32_t> welded = weld(mesh.positions);
    std::vector<glm::dvec3> sums(mPoints.size(), glm::dvec3(0.0));
    for (std::size_t t = 0; t < mIndices.size(); t += 3) {
        const std::array<std::uint32_t, 3> corner{mIndices[t], mIndices[t + 1], mIndices[t + 2]};
        if (welded[corner[0]] == welded[corner[1]] || welded[corner[1]] == welded[corner[2]] ||
            welded[corner[2]] == welded[corner[0]]) {
            continue;
        }
        mesh.indices.insert(mesh.indices.end(), corner.begin(), corner.end());
        std::array<glm::dvec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = glm::dvec3(mesh.positions[corner[i]]);
        }
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        if (length <= 0.0) {
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const double angle = angleBetween(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            sums[welded[corner[i]]] += angle / length * normal;
        }
    }
    mesh.normals.reserve(mPoints.size());
    for (const std::uint32_t vertex : welded) {
        const double length = glm::length(sums[vertex]);
        mesh.normals.emplace_back(length > 0.0 ? sums[vertex] / length : glm::dvec3(0.0, 1.0, 0.0));
    }
    Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.materials.emplace_back();
    scene.millimetersPerUnit = 1.0;
    return scene;
}

} // namespace celadon
