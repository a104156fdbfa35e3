#pragma once

#include "renderer/scene/world.h"

#include <glm/vec3.hpp>

#include <string_view>

/// Lights as the command line writes them, the falloff of a spot's cone, and the light that a scene
/// without any gets. Units: scene.h.
namespace celadon {

/// "directional", "point", "spot": on the command line, in the editor and in glTF.
[[nodiscard]] const char* lightKindName(Light::Kind kind);

/// Reads one `--light` argument (DESIGN section 5):
///   directional:DX,DY,DZ[:R,G,B]                          R,G,B irradiance on a plane facing it
///   point:X,Y,Z[:R,G,B]                                   R,G,B radiant intensity, W/sr
///   spot:X,Y,Z:DX,DY,DZ:INNER,OUTER[:R,G,B]               half angles in degrees
/// Directions are normalized; R,G,B left out is 1,1,1. Positions stay in model units.
/// @throws UsageError naming the argument: unknown kind, wrong number of fields, a number that is
///         not finite, a zero direction, a negative color, not 0 <= INNER < OUTER <= 90
[[nodiscard]] Light parseLight(std::string_view text);

/// A spot's falloff as shaders take it: clamp(scale * cosAngle + offset, 0, 1)^2.
struct SpotFalloff {
    double scale = 0.0;
    double offset = 1.0;
};

/// From the cones of a spot; for other kinds a falloff that is 1 everywhere.
///
/// glTF's KHR_lights_punctual: 1 inside the inner cone, 0 outside the outer one, the square of a
/// ramp over the cosine between. Its sample code also keeps the ramp at least 0.001 wide, which
/// would dim a spot of 1 degree to 2 % on its axis; here only a width of zero is guarded.
[[nodiscard]] SpotFalloff spotFalloff(const Light& light);

/// @param cosAngle cosine between the spot's direction and that from the light to the point
/// @return         fraction of the light's intensity, in [0, 1]
[[nodiscard]] double spotFactor(const Light& light, double cosAngle);

/// The one light of a scene that brings none: directional, seen from `camera` coming from behind
/// the object, above and to the right, so that thin parts glow and the far side of thick ones
/// fades; the lit side still shows to the camera as a broad rim. A one-sided sheet that would turn
/// its back to that light is lit from the camera.
[[nodiscard]] Light defaultLight(const Camera& camera, const World& world);

} // namespace celadon
