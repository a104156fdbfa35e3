#include "ui/length_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace celadon::ui {

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

} // namespace

std::optional<double> parseLengthMm(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
        {{"", 1.0}, {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"in", 25.4}}};
    std::string number(trimmed(text));
    std::ranges::replace(number, ',', '.');
    double value = 0.0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc()) {
        return std::nullopt;
    }
    const std::string_view unit = trimmed({end, number.data() + number.size()});
    const auto found = std::ranges::find(kUnits, unit, &std::pair<std::string_view, double>::first);
    if (found == kUnits.end() || !(value > 0.0) || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value * found->second;
}

std::string lengthText(double mm) {
    return fmt::format("{:.6g} mm", mm);
}

} // namespace celadon::ui
