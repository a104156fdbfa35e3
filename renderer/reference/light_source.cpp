#include "renderer/reference/light_source.h"

#include "renderer/reference/incidence.h"
#include "renderer/shading/fresnel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace celadon {

namespace {

constexpr double kSquareMetersPerSquareMillimeter = 1e-6;
/// A point light nearer than this many radii to the middle shines all around.
constexpr double kNear = 1.02;

double luminous(const Light& light) {
    return light.color.x + light.color.y + light.color.z;
}

} // namespace

LightSource::LightSource(const RayScene& rays, std::span<const Light> lights, double eta)
    : mRays(rays), mEta(eta) {
    double total = 0.0;
    for (const Light& light : lights) {
        if (light.color != glm::dvec3(0.0)) {
            mBeams.push_back(makeBeam(light));
            total += mBeams.back().probability;
        }
    }
    for (Beam& beam : mBeams) {
        beam.probability /= total;
    }
}

LightSource::Beam LightSource::makeBeam(const Light& light) const {
    const BoundingSphere& target = mRays.world().scatteringSphere;
    Beam beam{&light, light.direction, {}, {}, -1.0, 4.0 * std::numbers::pi, 0.0};
    if (light.kind == Light::Kind::Directional) {
        beam.measure =
            std::numbers::pi * target.radius * target.radius * kSquareMetersPerSquareMillimeter;
    } else {
        const glm::dvec3 toTarget = target.center - light.position;
        const double distance = glm::length(toTarget);
        double coneOfTarget = -1.0;
        if (distance > kNear * target.radius) {
            const double sine = target.radius / distance;
            coneOfTarget = std::sqrt(1.0 - sine * sine);
        }
        const double coneOfSpot =
            light.kind == Light::Kind::Spot ? std::cos(light.outerConeRadians) : -1.0;
        beam.cosCone = std::max(coneOfTarget, coneOfSpot);
        if (coneOfTarget > coneOfSpot) {
            beam.axis = toTarget / distance;
        }
        beam.measure = 2.0 * std::numbers::pi * (1.0 - beam.cosCone);
    }
    const glm::dvec3 helper =
        std::abs(beam.axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    beam.tangent = glm::normalize(glm::cross(helper, beam.axis));
    beam.bitangent = glm::cross(beam.axis, beam.tangent);
    beam.probability = luminous(light) * beam.measure;
    return beam;
}

std::optional<LightEntry> LightSource::sample(double choice, glm::dvec2 place) const {
    if (mBeams.empty()) {
        return std::nullopt;
    }
    std::size_t index = 0;
    while (index + 1 < mBeams.size() && choice >= mBeams[index].probability) {
        choice -= mBeams[index++].probability;
    }
    const Beam& beam = mBeams[index];
    const double phi = 2.0 * std::numbers::pi * place.x;
    const glm::dvec3 aside = std::cos(phi) * beam.tangent + std::sin(phi) * beam.bitangent;
    glm::dvec3 origin;
    glm::dvec3 direction = beam.axis;
    glm::dvec3 flux = beam.light->color * (beam.measure / beam.probability);
    if (beam.light->kind == Light::Kind::Directional) {
        const BoundingSphere& target = mRays.world().scatteringSphere;
        const BoundingSphere& scene = mRays.world().sceneSphere;
        const double back = glm::distance(target.center, scene.center) + 1.01 * scene.radius;
        origin = target.center + target.radius * std::sqrt(place.y) * aside - back * direction;
    } else {
        const double cosine = 1.0 - place.y * (1.0 - beam.cosCone);
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        origin = beam.light->position;
        direction = cosine * beam.axis + sine * aside;
        if (beam.light->kind == Light::Kind::Spot) {
            flux *= spotFactor(*beam.light, direction);
        }
    }
    const auto hit = mRays.nearest(origin, direction);
    if (!hit || flux == glm::dvec3(0.0)) {
        return std::nullopt;
    }
    const SurfacePoint point = surfacePoint(mRays.world(), hit->place);
    const std::optional<Facing> facing = facingLight(point, -direction);
    if (point.material < 0 || !facing || glm::dot(point.geometricNormal, direction) >= 0.0) {
        return std::nullopt;
    }
    std::optional<glm::dvec3> inside = refracted(-direction, point.shadingNormal, mEta);
    if (inside && glm::dot(*inside, point.geometricNormal) >= 0.0) {
        inside = refracted(-direction, point.geometricNormal, mEta);
    }
    if (!inside) {
        return std::nullopt;
    }
    return LightEntry{point, *inside, flux * fresnelTransmittance(facing->shadingCosine, mEta)};
}

} // namespace celadon
