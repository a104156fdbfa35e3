#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace celadon::ui {

/// A length as somebody types it: a number with a point or a comma, then mm (or nothing), cm, m or
/// in. @return mm; nothing where it is none, or not above 0
[[nodiscard]] std::optional<double> parseLengthMm(std::string_view text);

/// "113.6 mm", with six digits.
[[nodiscard]] std::string lengthText(double mm);

} // namespace celadon::ui
