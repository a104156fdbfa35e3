#pragma once

#include "renderer/reference/ray_scene.h"
#include "renderer/scene/scene.h"

#include <glm/vec3.hpp>

#include <limits>
#include <optional>

/// Light arriving at a point of a surface, and how much of it enters (DESIGN section 1).
namespace celadon {

struct Incidence {
    glm::dvec3 toLight{0.0}; ///< unit
    double distanceMm = std::numeric_limits<double>::infinity();
    glm::dvec3 irradiance{0.0}; ///< on a plane that faces the light, W/m^2, before Fresnel
};

/// What the light brings to a place with nothing in between; a point light at the very place
/// brings nothing.
/// @param light  positions in mm; direction of unit length
[[nodiscard]] Incidence incidenceAt(const Light& light, glm::dvec3 positionMm);

/// Spot factor as KHR_lights_punctual has it: the square of a linear ramp in the cosine.
[[nodiscard]] double spotFactor(const Light& light, glm::dvec3 fromLight);

/// How the surface stands to the light, if light can enter there: both the geometric and the
/// shading normal face it (turned over together where the look is double sided).
struct Facing {
    double geometricCosine; ///< in (0, 1]
    double shadingCosine;   ///< in (0, 1]
};
[[nodiscard]] std::optional<Facing> facingLight(const SurfacePoint& point, glm::dvec3 toLight);

} // namespace celadon
