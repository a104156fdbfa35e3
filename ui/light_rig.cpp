#include "ui/light_rig.h"

#include "renderer/scene/light.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr double kGizmoDistance = 1.35; ///< of a directional light, in bounding sphere radii
constexpr double kPlacedDistance = 1.6; ///< of a new point or spot light
constexpr double kApart = 0.2;          ///< that gizmos of new lights are from others
constexpr int kMostTurns = 17;          ///< of a new light about the object

/// A directional light that travels along a direction given in the camera's frame: x to the right,
/// y up, z away from the camera.
RigLight towards(const char* name, const CameraFrame& frame, glm::dvec3 direction,
                 glm::dvec3 color) {
    RigLight result;
    result.name = name;
    result.light.kind = Light::Kind::Directional;
    result.light.direction = glm::normalize(direction.x * frame.right + direction.y * frame.up +
                                            direction.z * frame.forward);
    result.light.color = color;
    return result;
}

/// About +y, from +z towards +x.
glm::dvec3 turned(const glm::dvec3& v, double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

} // namespace

bool areSame(std::span<const RigLight> a, std::span<const RigLight> b) {
    return std::ranges::equal(a, b, [](const RigLight& x, RigLight y) {
        if (x.followed && x.followed == y.followed) {
            y.light.position = x.light.position;
            y.light.direction = x.light.direction;
        }
        return x == y;
    });
}

std::vector<Light> LightRig::resolved() const {
    std::vector<Light> result;
    for (const RigLight& item : lights) {
        if (item.isOn) {
            result.push_back(item.light);
        }
    }
    return result;
}

Environment LightRig::around() const {
    if (!environment) {
        return {};
    }
    return {environment->map, environment->strength, glm::radians(environment->turnDegrees),
            environment->lights};
}

std::vector<std::string> lightPresetNames() {
    return {"back", "rim", "studio", "front"};
}

std::vector<RigLight> lightPreset(std::string_view name, const Camera& camera,
                                  const BoundingSphere& object) {
    static_cast<void>(object);
    const CameraFrame frame = cameraFrame(camera);
    const glm::dvec3 warm(1.0, 0.86, 0.68);
    const glm::dvec3 cool(0.72, 0.86, 1.0);
    if (name == "back") {
        return {towards("Back light", frame, {-0.55, -0.5, -0.85}, 6.0 * warm),
                towards("Fill", frame, {0.75, -0.35, 0.7}, 0.7 * cool)};
    }
    if (name == "rim") {
        return {towards("Right rim", frame, {-1.0, -0.3, -0.45}, 4.5 * warm),
                towards("Left rim", frame, {1.0, -0.25, -0.45}, 4.0 * cool)};
    }
    if (name == "studio") {
        return {towards("Key", frame, {-0.7, -0.6, 0.75}, 2.6 * glm::dvec3(1.0, 0.95, 0.88)),
                towards("Fill", frame, {0.9, -0.1, 0.7}, 0.8 * cool),
                towards("Back", frame, {0.4, -0.6, -1.0}, 3.0 * warm)};
    }
    if (name == "front") {
        return {towards("Front light", frame, {-0.35, -0.35, 1.0}, glm::dvec3(2.4))};
    }
    throw UsageError(fmt::format("light preset '{}'", name), "there is no such preset",
                     "choose back, rim, studio or front");
}

RigLight newLight(Light::Kind kind, const Camera& camera, const BoundingSphere& object,
                  std::span<const RigLight> others) {
    const CameraFrame frame = cameraFrame(camera);
    RigLight result = towards("", frame, {-0.6, -0.6, -0.5}, glm::dvec3(1.0));
    Light& light = result.light;
    light.kind = kind;
    const double distanceMm = kPlacedDistance * object.radius;
    const auto place = [&] { light.position = object.center - distanceMm * light.direction; };
    const auto isOverAnother = [&] {
        return std::ranges::any_of(others, [&](const RigLight& other) {
            return glm::distance(gizmoPosition(other.light, object), gizmoPosition(light, object)) <
                   kApart * object.radius;
        });
    };
    place();
    for (int i = 0; i < kMostTurns && isOverAnother(); ++i) { // its gizmo would hide
        light.direction = turned(light.direction, glm::radians(20.0));
        place();
    }
    // As much irradiance at the object's center as a directional light of 4 W/m^2 would bring.
    const double meters = distanceMm * 1e-3;
    light.color = glm::dvec3(kind == Light::Kind::Directional ? 4.0 : 4.0 * meters * meters);
    light.innerConeRadians = glm::radians(18.0);
    light.outerConeRadians = glm::radians(28.0);
    result.name = kind == Light::Kind::Directional ? "Directional"
                  : kind == Light::Kind::Point     ? "Point"
                                                   : "Spot";
    return result;
}

Light::Kind parseLightKind(std::string_view name) {
    for (const Light::Kind kind :
         {Light::Kind::Directional, Light::Kind::Point, Light::Kind::Spot}) {
        if (name == lightKindName(kind)) {
            return kind;
        }
    }
    throw UsageError(fmt::format("light '{}'", name), "there is no such kind",
                     "choose directional, point or spot");
}

glm::dvec3 gizmoPosition(const Light& light, const BoundingSphere& object) {
    return light.kind == Light::Kind::Directional
               ? object.center - kGizmoDistance * object.radius * light.direction
               : light.position;
}

Light movedTo(const Light& light, const glm::dvec3& position, const BoundingSphere& object) {
    Light result = light;
    const glm::dvec3 toObject = object.center - position;
    if (light.kind != Light::Kind::Directional) {
        result.position = position;
    }
    if (light.kind != Light::Kind::Point && glm::length(toObject) > 1e-6 * object.radius) {
        result.direction = glm::normalize(toObject);
    }
    return result;
}

float fittingExposureEv(std::span<const Light> lights, const BoundingSphere& object) {
    constexpr double kWellExposed = 5.0; // W/m^2, as the default light brings
    constexpr glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);
    double irradiance = 0.0;
    for (const Light& light : lights) {
        double distanceM = 1.0;
        if (light.kind != Light::Kind::Directional) {
            distanceM = std::max(glm::distance(light.position, object.center), object.radius) / 1e3;
        }
        irradiance += glm::dot(light.color, kLuminance) / (distanceM * distanceM);
    }
    const double stops = irradiance > 0.0 ? std::log2(kWellExposed / irradiance) : 0.0;
    return std::abs(stops) > 1.0 ? static_cast<float>(std::clamp(std::round(stops), -20.0, 20.0))
                                 : 0.0f;
}

void turnAround(const glm::dvec3& center, std::span<RigLight> lights, double degrees) {
    const double radians = glm::radians(degrees);
    for (RigLight& item : lights) {
        item.light.position = center + turned(item.light.position - center, radians);
        item.light.direction = turned(item.light.direction, radians);
    }
}

void turnAround(Camera& camera, LightRig& rig, double degrees) {
    const double radians = glm::radians(degrees);
    const glm::dvec3 center = camera.at;
    camera.eye = center + turned(camera.eye - center, radians);
    camera.up = turned(camera.up, radians);
    turnAround(center, rig.lights, degrees);
    if (rig.environment) {
        rig.environment->turnDegrees =
            std::remainder(rig.environment->turnDegrees + degrees, 360.0);
    }
}

} // namespace celadon::ui
