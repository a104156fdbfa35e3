#include "renderer/scene/camera.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon {

namespace {

/// Sine of the least angle between the view and its up vector: below, rounding would pick the roll.
constexpr double kLeastSine = 1e-6;

/// Nearest visible depth, unless the target is closer than some ten millimeters.
constexpr double kNearMm = 1e-3;

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string describe(const glm::dvec3& v) {
    return fmt::format("{:g},{:g},{:g}", v.x, v.y, v.z);
}

} // namespace

void validateCamera(const Camera& camera) {
    const std::string subject = camera.name.empty()
                                    ? std::string("the view")
                                    : fmt::format("the view of camera '{}'", camera.name);
    if (!isFinite(camera.eye) || !isFinite(camera.at) || !isFinite(camera.up)) {
        throw UsageError(subject, "its position, target or up vector is not finite");
    }
    const glm::dvec3 forward = camera.at - camera.eye;
    const double distance = glm::length(forward);
    const double magnitude = std::max(glm::length(camera.eye), glm::length(camera.at));
    if (!std::isfinite(distance) || distance <= 1e-12 * magnitude || distance == 0.0) {
        throw UsageError(subject,
                         fmt::format("it looks from {} at the same place", describe(camera.eye)),
                         "move --view-from or --view-at");
    }
    const double upLength = glm::length(camera.up);
    if (!(upLength > 0.0) ||
        glm::length(glm::cross(forward / distance, camera.up / upLength)) < kLeastSine) {
        throw UsageError(
            subject, fmt::format("its up vector {} is zero or along the view", describe(camera.up)),
            "give another --view-up");
    }
    if (camera.orthographicHeight) {
        if (!std::isfinite(*camera.orthographicHeight) || *camera.orthographicHeight <= 0.0) {
            throw UsageError(subject, fmt::format("an orthographic height of {:g} is not positive",
                                                  *camera.orthographicHeight));
        }
    } else if (!(camera.fovYDegrees > 0.0 && camera.fovYDegrees < 180.0)) {
        throw UsageError(subject,
                         fmt::format("a vertical field of view of {:g} degrees is outside (0, 180)",
                                     camera.fovYDegrees),
                         "give another --fov");
    }
}

CameraFrame cameraFrame(const Camera& camera) {
    validateCamera(camera);
    CameraFrame frame;
    frame.forward = glm::normalize(camera.at - camera.eye);
    frame.right = glm::normalize(glm::cross(frame.forward, glm::normalize(camera.up)));
    frame.up = glm::cross(frame.right, frame.forward);
    return frame;
}

CameraView makeCameraView(const Camera& camera, int widthPx, int heightPx, glm::dvec2 jitterPx) {
    CameraView result;
    result.frame = cameraFrame(camera);
    result.eye = camera.eye;
    result.orthographic = camera.orthographicHeight.has_value();

    const CameraFrame& f = result.frame;
    glm::dmat4 view(1.0);
    view = glm::row(view, 0, glm::dvec4(f.right, -glm::dot(f.right, camera.eye)));
    view = glm::row(view, 1, glm::dvec4(f.up, -glm::dot(f.up, camera.eye)));
    view = glm::row(view, 2, glm::dvec4(-f.forward, glm::dot(f.forward, camera.eye)));
    result.view = glm::mat4(view);

    const double aspect = static_cast<double>(widthPx) / heightPx;
    const glm::dvec2 jitterClip = 2.0 * jitterPx / glm::dvec2(widthPx, heightPx);
    glm::dmat4 projection(0.0); // [column][row]
    if (result.orthographic) {
        const double height = *camera.orthographicHeight;
        projection[0][0] = 2.0 / (height * aspect);
        projection[1][1] = 2.0 / height;
        projection[3] = glm::dvec4(jitterClip, 0.0, 1.0);
        result.pixelWidth = {0.0, height / heightPx};
    } else {
        const double tangent = std::tan(glm::radians(0.5 * camera.fovYDegrees));
        projection[0][0] = 1.0 / (tangent * aspect);
        projection[1][1] = 1.0 / tangent;
        projection[2] = glm::dvec4(-jitterClip, 0.0, -1.0);
        projection[3][2] = std::min(kNearMm, 1e-4 * glm::length(camera.at - camera.eye));
        result.pixelWidth = {2.0 * tangent / heightPx, 0.0};
    }
    result.projection = glm::mat4(projection);
    return result;
}

bool isOutsideView(const CameraView& view, const BoundingSphere& sphere) {
    const glm::dmat4 clip = glm::dmat4(view.projection) * glm::dmat4(view.view);
    const glm::dvec4 w = glm::row(clip, 3);
    // The four sides and, in front of a perspective eye, w > 0.
    for (int axis = 0; axis < 2; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec4 plane = w + side * glm::row(clip, axis);
            const double distance = glm::dot(plane, glm::dvec4(sphere.center, 1.0));
            if (distance < -sphere.radius * glm::length(glm::dvec3(plane))) {
                return true;
            }
        }
    }
    return !view.orthographic &&
           glm::dot(sphere.center - view.eye, view.frame.forward) < -sphere.radius;
}

} // namespace celadon
