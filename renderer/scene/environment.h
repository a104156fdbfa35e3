#pragma once

#include "renderer/scene/scene.h"

#include <glm/vec3.hpp>

#include <filesystem>
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

} // namespace celadon
