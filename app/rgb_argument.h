#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string>

/// Numbers given on the command line.
namespace celadon::app {

/// "0.9,0.7,0.2", or one number for all three channels. Nothing if it is not numbers at all.
[[nodiscard]] std::optional<glm::dvec3> parseRgb(const std::string& text);

/// As above, and each in [low, high].
/// @param option for messages: "--absorption"
/// @throws UsageError naming the option, the channel and the reason
[[nodiscard]] glm::dvec3 requireRgb(const std::string& option, const std::string& text, double low,
                                    double high);

} // namespace celadon::app
