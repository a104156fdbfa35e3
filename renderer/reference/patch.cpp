#include "renderer/reference/patch.h"

#include <algorithm>

namespace celadon {

glm::dvec3 totalFlux(std::span<const Patch> patches) {
    glm::dvec3 sum(0.0);
    for (const Patch& patch : patches) {
        sum += glm::dvec3(patch.flux);
    }
    return sum;
}

Patch makePatch(glm::vec3 positionMm, glm::vec3 normal, glm::vec3 flux, float varianceMm2,
                glm::vec2 uv, int material) {
    const float h = 0.5f * varianceMm2;
    const glm::vec3 n = normal;
    Patch patch;
    patch.positionMm = positionMm;
    patch.normal = normal;
    patch.flux = flux;
    patch.covariance = {h * (1 - n.x * n.x), -h * n.x * n.y, -h * n.x * n.z,
                        h * (1 - n.y * n.y), -h * n.y * n.z, h * (1 - n.z * n.z)};
    patch.uv = uv;
    patch.material = material;
    return patch;
}

Patch makeTexelPatch(glm::vec3 positionMm, glm::vec3 normal, glm::vec3 flux, float crossSectionMm2,
                     float cosine, glm::vec2 uv, int material) {
    // Beyond the clamp a texel is seen edge on: how far it really reaches is unknown.
    constexpr float kLeastCosine = 0.1f;
    const float c = std::max(kLeastCosine, cosine);
    const float variance = crossSectionMm2 / (6.0f * c * c);
    return makePatch(positionMm, normal, flux, variance, uv, material);
}

} // namespace celadon
