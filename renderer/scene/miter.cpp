#include "renderer/scene/motion.h"
#include "renderer/scene/weld_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace celadon {

namespace {

constexpr double kLongestMiter = 4.0;

double angleAt(const glm::dvec3& corner, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 u = b - corner;
    const glm::dvec3 v = c - corner;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
}

} // namespace

std::vector<glm::vec3> miterDirections(const Mesh& rest) {
    std::vector<glm::vec3> positions = rest.positions;
    std::vector<glm::vec3> normals = rest.normals;
    const MeshBinding* const binding = rest.binding.get();
    const bool isFlat = binding != nullptr && binding->normals.empty();
    for (std::size_t i = 0; binding != nullptr && i < positions.size(); ++i) {
        positions[i] = binding->positions[rest.bindingVertices[i]];
        normals[i] = isFlat ? glm::vec3(0.0f) : binding->normals[rest.bindingVertices[i]];
    }
    for (std::size_t t = 0; isFlat && t + 2 < rest.indices.size(); t += 3) {
        const std::uint32_t* const corner = &rest.indices[t];
        const glm::dvec3 a(positions[corner[0]]);
        const glm::dvec3 n =
            glm::cross(glm::dvec3(positions[corner[1]]) - a, glm::dvec3(positions[corner[2]]) - a);
        for (int k = 0; k < 3; ++k) {
            normals[corner[k]] = glm::vec3(unitOr(n, glm::dvec3(0.0)));
        }
    }
    const std::vector<std::uint32_t> group = weldVertices(positions);
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
    std::vector<glm::dvec2> heights(positions.size(), glm::dvec2(0.0)); // weighted sum, weights
    const auto forEachCorner = [&](auto&& visit) {
        for (std::size_t t = 0; t + 2 < rest.indices.size(); t += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = rest.indices[t + k];
                const double angle = angleAt(glm::dvec3(positions[v]),
                                             glm::dvec3(positions[rest.indices[t + (k + 1) % 3]]),
                                             glm::dvec3(positions[rest.indices[t + (k + 2) % 3]]));
                visit(group[v], angle, unitOr(glm::dvec3(normals[v]), glm::dvec3(0.0)));
            }
        }
    };
    forEachCorner(
        [&](std::uint32_t g, double angle, const glm::dvec3& n) { sums[g] += angle * n; });
    for (glm::dvec3& sum : sums) {
        sum = unitOr(sum, glm::dvec3(0.0));
    }
    forEachCorner([&](std::uint32_t g, double angle, const glm::dvec3& n) {
        heights[g] += angle * glm::dvec2(glm::dot(sums[g], n), 1.0);
    });
    std::vector<glm::vec3> miters(positions.size());
    for (std::size_t i = 0; i < miters.size(); ++i) {
        const glm::dvec2 height = heights[group[i]];
        const double length =
            height.y > 0.0 ? std::min(height.y / std::max(height.x, 1e-9), kLongestMiter) : 1.0;
        miters[i] = glm::vec3(length * sums[group[i]]);
    }
    return miters;
}

bool needsMiters(const Pose& pose) {
    return std::any_of(pose.deformers.begin(), pose.deformers.end(), [](const Deformer& deformer) {
        return deformer.kind == Deformer::Kind::Inflate;
    });
}

} // namespace celadon
