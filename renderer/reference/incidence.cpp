#include "renderer/reference/incidence.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon {

double spotFactor(const Light& light, glm::dvec3 fromLight) {
    const double cosine = glm::dot(fromLight, light.direction);
    const double inner = std::cos(light.innerConeRadians);
    const double outer = std::cos(light.outerConeRadians);
    // Equal cones are a hard edge; 1e-4 is the extension's own guard against dividing by zero.
    const double ramp = (cosine - outer) / std::max(inner - outer, 1e-4);
    const double clamped = std::clamp(ramp, 0.0, 1.0);
    return clamped * clamped;
}

Incidence incidenceAt(const Light& light, glm::dvec3 positionMm) {
    Incidence incidence;
    if (light.kind == Light::Kind::Directional) {
        incidence.toLight = -light.direction;
        incidence.irradiance = light.color;
        return incidence;
    }
    constexpr double kMillimetersPerMeter = 1000.0;
    const glm::dvec3 delta = light.position - positionMm;
    incidence.distanceMm = glm::length(delta);
    if (incidence.distanceMm <= 0.0) {
        return incidence;
    }
    incidence.toLight = delta / incidence.distanceMm;
    const double distanceM = incidence.distanceMm / kMillimetersPerMeter;
    incidence.irradiance = light.color / (distanceM * distanceM);
    if (light.kind == Light::Kind::Spot) {
        incidence.irradiance *= spotFactor(light, -incidence.toLight);
    }
    return incidence;
}

std::optional<Facing> facingLight(const SurfacePoint& point, glm::dvec3 toLight) {
    Facing facing{glm::dot(point.geometricNormal, toLight), glm::dot(point.shadingNormal, toLight)};
    if (point.doubleSided && facing.geometricCosine < 0.0) {
        facing = {-facing.geometricCosine, -facing.shadingCosine};
    }
    if (facing.geometricCosine <= 0.0 || facing.shadingCosine <= 0.0) {
        return std::nullopt;
    }
    return facing;
}

} // namespace celadon
