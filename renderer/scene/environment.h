#pragma once

#include "renderer/scene/scene.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Environment light: a latitude-longitude map of radiance, turned into directional lights by
/// importance sampling. Row 0 is +y (up); the center column looks along -z; u grows towards +x.
namespace celadon {

struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance; ///< [height][width], W/m^2/sr, finite, >= 0
    std::vector<std::string> warnings;
};

/// A map as a scene uses it.
struct Environment {
    std::shared_ptr<const EnvironmentMap> map; ///< null: none
    double strength = 1.0;                     ///< multiplies the radiance
    double turnRadians = 0.0;                  ///< about +y, from +z towards +x
    int lights = 64;                           ///< that stand for it where it is scattered
    [[nodiscard]] bool operator==(const Environment&) const = default;
    [[nodiscard]] explicit operator bool() const { return map != nullptr && strength > 0.0; }
};

/// @throws InputError: unreadable, no R,G,B channels, NaN or infinite pixels. Negative pixels are
///         clamped to 0 with a warning.
[[nodiscard]] EnvironmentMap readEnvironment(const std::filesystem::path& file);

/// Radiance seen when looking along `direction` (unit), bilinear, wrapping in longitude.
[[nodiscard]] glm::vec3 environmentRadiance(const EnvironmentMap& map, glm::dvec3 direction);

/// Splits the sphere into `count` regions of about equal power (median cut over luminance times
/// solid angle); each light carries its region's exact irradiance (sum of radiance times solid
/// angle) from its power-weighted mean direction, so that the sum over lights is the map's
/// integral. Deterministic. Fewer lights where the map has fewer lit texels; none for a black map.
[[nodiscard]] std::vector<Light> environmentLights(const EnvironmentMap& map, int count);
/// Those of a map that is turned and scaled; none of none.
[[nodiscard]] std::vector<Light> environmentLights(const Environment& environment);

/// A direction of the world in the map's own frame, before it was turned.
[[nodiscard]] glm::dvec3 turnedBack(const glm::dvec3& direction, double turnRadians);

/// Half the width and height (rounded up): means over 2 x 2 texels, weighted by solid angle.
[[nodiscard]] EnvironmentMap halved(const EnvironmentMap& map);

} // namespace celadon
