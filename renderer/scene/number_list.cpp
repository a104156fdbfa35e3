#include "renderer/scene/number_list.h"

#include "subedit/errors.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace celadon {

namespace {

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> parseNumber(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) { // from_chars knows no leading plus
        text.remove_prefix(1);
        if (text.starts_with('-')) {
            return std::nullopt;
        }
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

} // namespace

std::optional<std::vector<double>> parseNumbers(std::string_view text) {
    std::vector<double> numbers;
    for (;;) {
        const std::size_t comma = text.find(',');
        const std::optional<double> number = parseNumber(text.substr(0, comma));
        if (!number) {
            return std::nullopt;
        }
        numbers.push_back(*number);
        if (comma == std::string_view::npos) {
            return numbers;
        }
        text.remove_prefix(comma + 1);
    }
}

glm::dvec3 parseTriple(std::string_view text, const std::string& option) {
    const std::optional<std::vector<double>> numbers = parseNumbers(text);
    if (!numbers || numbers->size() != 3) {
        throw UsageError(fmt::format("{} '{}'", option, text), "not three finite numbers",
                         "write it as X,Y,Z");
    }
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

} // namespace celadon
