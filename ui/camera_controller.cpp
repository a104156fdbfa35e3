#include "ui/camera_controller.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr double kSteepest = 89.9; ///< degrees: +y stays a valid up vector
constexpr double kLeastDistanceMm = 1e-3;

double tangent(const Camera& camera) {
    return std::tan(glm::radians(0.5 * camera.fovYDegrees));
}

Camera fromAngles(const Camera& camera, double azimuthDegrees, double elevationDegrees,
                  double distance) {
    const double azimuth = glm::radians(azimuthDegrees);
    const double elevation = glm::radians(std::clamp(elevationDegrees, -kSteepest, kSteepest));
    Camera result = camera;
    result.up = {0.0, 1.0, 0.0};
    result.eye = camera.at + distance * glm::dvec3(std::cos(elevation) * std::sin(azimuth),
                                                   std::sin(elevation),
                                                   std::cos(elevation) * std::cos(azimuth));
    return result;
}

} // namespace

Camera orbited(const Camera& camera, double azimuthDegrees, double elevationDegrees) {
    const glm::dvec3 offset = camera.eye - camera.at;
    const double distance = glm::length(offset);
    const double azimuth = glm::degrees(std::atan2(offset.x, offset.z));
    const double elevation = glm::degrees(std::asin(std::clamp(offset.y / distance, -1.0, 1.0)));
    return fromAngles(camera, azimuth - azimuthDegrees, elevation + elevationDegrees, distance);
}

Camera panned(const Camera& camera, double rightMm, double upMm) {
    const CameraFrame frame = cameraFrame(camera);
    const glm::dvec3 shift = rightMm * frame.right + upMm * frame.up;
    Camera result = camera;
    result.eye += shift;
    result.at += shift;
    return result;
}

Camera zoomed(const Camera& camera, double factor, const glm::dvec3& pivot) {
    Camera result = camera;
    const double distance = glm::length(camera.eye - camera.at);
    const double least = std::max(kLeastDistanceMm / distance, 1e-6);
    const double f = std::clamp(factor, least, 1e6);
    result.eye = pivot + f * (camera.eye - pivot);
    result.at = pivot + f * (camera.at - pivot);
    if (result.orthographicHeight) {
        *result.orthographicHeight *= f;
    }
    return result;
}

Camera framed(const Camera& camera, const World& world, double aspect) {
    // chooseCamera looks along the wanted direction when both points lie on it; what it chooses for
    // a view that is not placed fits the vertices. Here the direction is ours: the sphere is
    // fitted.
    const BoundingSphere& sphere = world.scatteringSphere;
    const glm::dvec3 direction = glm::normalize(camera.eye - camera.at);
    const double halfAngle =
        std::atan(tangent(camera) * std::min(1.0, aspect)) * 0.96; // a margin of 4 %
    Camera result = camera;
    result.at = sphere.center;
    result.eye = sphere.center + direction * (sphere.radius / std::sin(halfAngle));
    if (result.orthographicHeight) {
        result.orthographicHeight = 2.1 * sphere.radius / std::min(1.0, aspect);
    }
    return result;
}

Camera standardView(const Camera& camera, std::string_view name) {
    const double distance = glm::length(camera.eye - camera.at);
    struct View {
        std::string_view name;
        double azimuth, elevation;
    };
    for (const View& view :
         {View{"front", 0.0, 0.0}, View{"back", 180.0, 0.0}, View{"right", 90.0, 0.0},
          View{"left", -90.0, 0.0}, View{"top", 0.0, 90.0}, View{"bottom", 0.0, -90.0}}) {
        if (view.name == name) {
            return fromAngles(camera, view.azimuth, view.elevation, distance);
        }
    }
    throw UsageError(fmt::format("view '{}'", name), "there is no such view",
                     "choose front, back, right, left, top or bottom");
}

Camera withProjection(const Camera& camera, bool orthographic) {
    if (camera.orthographicHeight.has_value() == orthographic) {
        return camera;
    }
    Camera result = camera;
    const double distance = glm::length(camera.eye - camera.at);
    if (orthographic) {
        result.orthographicHeight = 2.0 * distance * tangent(camera);
    } else {
        const double wanted = 0.5 * *camera.orthographicHeight / tangent(camera);
        result.orthographicHeight.reset();
        result.eye = camera.at + (camera.eye - camera.at) * (wanted / distance);
    }
    return result;
}

Ray rayThrough(const Camera& camera, glm::dvec2 place, double aspect) {
    const CameraFrame frame = cameraFrame(camera);
    const glm::dvec2 ndc(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y);
    if (camera.orthographicHeight) {
        const double half = 0.5 * *camera.orthographicHeight;
        // From well behind the eye: an orthographic view sees what is there, too.
        const double back = 1e3 * half;
        return {camera.eye + ndc.x * half * aspect * frame.right + ndc.y * half * frame.up -
                    back * frame.forward,
                frame.forward};
    }
    const double t = tangent(camera);
    return {camera.eye, glm::normalize(frame.forward + ndc.x * t * aspect * frame.right +
                                       ndc.y * t * frame.up)};
}

glm::dvec3 projected(const Camera& camera, const glm::dvec3& point, double aspect) {
    const CameraFrame frame = cameraFrame(camera);
    const glm::dvec3 offset = point - camera.eye;
    const double depth = glm::dot(offset, frame.forward);
    const double half = camera.orthographicHeight ? 0.5 * *camera.orthographicHeight
                                                  : std::max(depth, 1e-9) * tangent(camera);
    const glm::dvec2 ndc(glm::dot(offset, frame.right) / (half * aspect),
                         glm::dot(offset, frame.up) / half);
    return {0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y, camera.orthographicHeight ? 1.0 : depth};
}

double pictureHeightMm(const Camera& camera, const glm::dvec3& point) {
    if (camera.orthographicHeight) {
        return *camera.orthographicHeight;
    }
    const double depth = glm::dot(point - camera.eye, cameraFrame(camera).forward);
    return 2.0 * std::max(depth, kLeastDistanceMm) * tangent(camera);
}

} // namespace celadon::ui
