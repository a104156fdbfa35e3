#pragma once

#include "renderer/scene/scene.h"
#include "renderer/scene/world.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

/// Which view to take, and the matrices that it means. Clip space is OpenGL's with a depth range of
/// zero to one (glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE)) and reversed: the near plane has
/// depth 1, the far plane 0; compare with GL_GREATER and clear to 0.
namespace celadon {

/// Orthonormal, right-handed: right x up = -forward.
struct CameraFrame {
    glm::dvec3 right{1.0, 0.0, 0.0};
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};
};

/// @throws UsageError as validateCamera
[[nodiscard]] CameraFrame cameraFrame(const Camera& camera);

/// @throws UsageError: a number that is not finite, eye and target at one place, up zero or
///         parallel to the view, a field of view outside (0, 180) degrees, an orthographic height
///         that is not positive
void validateCamera(const Camera& camera);

/// What the command line says about the view, in model units; the rest is chosen.
struct ViewRequest {
    std::optional<glm::dvec3> from;
    std::optional<glm::dvec3> at;
    std::optional<glm::dvec3> up;
    std::optional<double> fovYDegrees;
};

/// The view of a world, in millimeters: what is asked for; else the file's first camera; else a
/// three-quarter view, from above and to the right of +z, that fits every scattering vertex. Once
/// `from` or `at` is given, the file's camera no longer counts. A target left out is the center of
/// the scattering bounding sphere; an eye left out looks from the three-quarter direction, as far
/// off as fits. An up vector left out is +y, or -z where the view is along y.
/// @param aspect width over height of the picture
/// @throws UsageError as validateCamera
[[nodiscard]] Camera chooseCamera(const World& world, const ViewRequest& request, double aspect);

/// How wide a pixel is, in mm on a plane that faces the camera at `depth` mm in front of it:
/// scale * depth + offset. Perspective has no offset, an orthographic view no scale.
struct PixelWidth {
    double scale = 0.0;
    double offset = 0.0;
    [[nodiscard]] double atDepthMm(double depthMm) const { return scale * depthMm + offset; }
};

/// A camera with the size of a picture. It does not depend on what there is to see, so that a shape
/// may move on the GPU without the CPU knowing where to.
struct CameraView {
    glm::mat4 view{1.0f}; ///< world mm -> camera mm; looks along -z
    /// Camera -> clip. Perspective: reversed depth, that of the near plane over it. Orthographic:
    /// depth is zero here; surface.vert spreads it over the scene's bounds.
    glm::mat4 projection{1.0f};
    CameraFrame frame;
    glm::dvec3 eye{0.0};
    PixelWidth pixelWidth;
    bool orthographic = false;
};

/// A perspective view has no far plane, and a near one close enough for anything: reversed depth in
/// float is as exact at any ratio of the two. An orthographic view sees what is behind the eye,
/// too.
/// @param jitterPx moves the picture by so many pixels (x to the right, y up), for antialiasing
/// @throws UsageError as validateCamera
[[nodiscard]] CameraView makeCameraView(const Camera& camera, int widthPx, int heightPx,
                                        glm::dvec2 jitterPx = glm::dvec2(0.0));

/// Whether no part of a sphere can be seen: what a black picture should say. Conservative: true
/// only where it is certain.
[[nodiscard]] bool isOutsideView(const CameraView& view, const BoundingSphere& sphere);

} // namespace celadon
