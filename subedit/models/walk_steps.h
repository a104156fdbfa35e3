#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

/// The chances of a random walk in a scattering medium: how far, and whereto. `Random` has
/// uniform() in [0, 1).
namespace celadon::subedit {

/// In mean free paths: exponential, mean 1.
template<typename Random>
double freePath(Random& random) {
    return -std::log(1.0 - random.uniform());
}

/// A point within the unit circle. @return its squared distance from the center, in (0, 1)
template<typename Random>
double pointInDisk(Random& random, double& x, double& y) {
    double squared = 0.0;
    do {
        x = 2.0 * random.uniform() - 1.0;
        y = 2.0 * random.uniform() - 1.0;
        squared = x * x + y * y;
    } while (squared >= 1.0 || squared == 0.0);
    return squared;
}

template<typename Random>
glm::dvec3 isotropicDirection(Random& random) {
    double x = 0.0;
    double y = 0.0;
    const double squared = pointInDisk(random, x, y); // Marsaglia 1972
    const double factor = 2.0 * std::sqrt(1.0 - squared);
    return {x * factor, y * factor, 1.0 - 2.0 * squared};
}

/// Direction at an angle of the given cosine to `axis`, evenly around it. All of unit length.
template<typename Random>
glm::dvec3 directionAround(const glm::dvec3& axis, double cosine, Random& random) {
    double x = 0.0;
    double y = 0.0;
    const double squared = pointInDisk(random, x, y);
    const double scale = std::sqrt(std::max(1.0 - cosine * cosine, 0.0) / squared);
    const glm::dvec3 helper =
        std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(helper, axis));
    const glm::dvec3 bitangent = glm::cross(axis, tangent);
    return glm::normalize(cosine * axis + scale * (x * tangent + y * bitangent));
}

/// Henyey, Greenstein 1941, by the inverse of its distribution function.
/// @param g mean cosine, in (-1, 1)
template<typename Random>
glm::dvec3 scatter(const glm::dvec3& direction, double g, Random& random) {
    if (std::abs(g) < 1e-4) {
        return isotropicDirection(random);
    }
    const double inner = (1.0 - g * g) / (1.0 - g + 2.0 * g * random.uniform());
    const double cosine = (1.0 + g * g - inner * inner) / (2.0 * g);
    return directionAround(direction, std::clamp(cosine, -1.0, 1.0), random);
}

} // namespace celadon::subedit
