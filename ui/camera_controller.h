#pragma once

#include "renderer/scene/camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string_view>

/// What hands do to a camera, as pure functions of cameras in mm: a turntable about `at`, whose
/// axis is +y.
namespace celadon::ui {

/// Turns the eye about `at`. The poles are approached, never passed.
/// @param azimuthDegrees to the right as seen from above @param elevationDegrees upwards
[[nodiscard]] Camera orbited(const Camera& camera, double azimuthDegrees, double elevationDegrees);

/// Shifts eye and target in the picture plane.
[[nodiscard]] Camera panned(const Camera& camera, double rightMm, double upMm);

/// Moves towards `pivot`, whose place in the picture stays.
/// @param factor of the distance: below 1 is nearer, > 0
[[nodiscard]] Camera zoomed(const Camera& camera, double factor, const glm::dvec3& pivot);

/// From the same direction, as far off as fits.
[[nodiscard]] Camera framed(const Camera& camera, const World& world, double aspect);

/// @param name front, back, right, left, top, bottom
/// @throws UsageError for another name
[[nodiscard]] Camera standardView(const Camera& camera, std::string_view name);

/// Perspective to orthographic and back, with the target at the same size.
[[nodiscard]] Camera withProjection(const Camera& camera, bool orthographic);

/// A ray through a place of the picture.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0}; ///< unit
};
/// @param place (0,0) top left, (1,1) bottom right
[[nodiscard]] Ray rayThrough(const Camera& camera, glm::dvec2 place, double aspect);
/// The inverse: where a point is seen; z is its depth in mm along the view, <= 0 behind the eye.
[[nodiscard]] glm::dvec3 projected(const Camera& camera, const glm::dvec3& point, double aspect);
/// Millimeters per unit of picture height, on a plane that faces the camera at the point.
[[nodiscard]] double pictureHeightMm(const Camera& camera, const glm::dvec3& point);

} // namespace celadon::ui
