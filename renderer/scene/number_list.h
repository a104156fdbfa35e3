#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Numbers separated by commas, as command-line options write vectors and colors: `1,-2.5,3e2`.
/// Independent of the locale.
namespace celadon {

/// Every field must be a whole finite number; blanks around fields are allowed.
/// @return nothing when a field is empty, is not a number, overflows, or is NaN or infinite
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text);

/// Three numbers, `X,Y,Z`.
/// @param option names the argument in the message: "--view-from"
/// @throws UsageError naming the option and what it was given
[[nodiscard]] glm::dvec3 parseTriple(std::string_view text, const std::string& option);

} // namespace celadon
