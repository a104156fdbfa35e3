#include "renderer/scene/scene.h"

#include <algorithm>
#include <limits>

namespace celadon {

BoundingSphere boundingSphere(const Scene& scene, const std::vector<bool>& include) {
    std::vector<const Mesh*> meshes;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (include.empty() || include[m]) {
            meshes.push_back(&scene.meshes[m]);
        }
    }
    return boundingSphere(meshes);
}

BoundingSphere boundingSphere(std::span<const Mesh* const> meshes) {
    const auto forEachUsedVertex = [&](auto&& visit) {
        for (const Mesh* const mesh : meshes) {
            for (const std::uint32_t index : mesh->indices) {
                visit(glm::dvec3(mesh->positions[index]));
            }
        }
    };
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    forEachUsedVertex([&](const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
    BoundingSphere sphere;
    if (low.x > high.x) {
        return sphere;
    }
    sphere.center = 0.5 * (low + high);
    double squared = 0.0;
    forEachUsedVertex([&](const glm::dvec3& p) {
        squared = std::max(squared, glm::dot(p - sphere.center, p - sphere.center));
    });
    sphere.radius = std::sqrt(squared);
    return sphere;
}

} // namespace celadon
