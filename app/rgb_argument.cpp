#include "app/rgb_argument.h"

#include "subedit/errors.h"
#include "subedit/medium.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

namespace celadon::app {

std::optional<glm::dvec3> parseRgb(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    for (;;) {
        double number = 0.0;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc{}) {
            return std::nullopt;
        }
        numbers.push_back(number);
        if (next == end) {
            break;
        }
        if (*next != ',' || numbers.size() == 3) {
            return std::nullopt;
        }
        at = next + 1;
    }
    if (numbers.size() == 1) {
        return glm::dvec3(numbers[0]);
    }
    if (numbers.size() == 3) {
        return glm::dvec3(numbers[0], numbers[1], numbers[2]);
    }
    return std::nullopt;
}

glm::dvec3 requireRgb(const std::string& option, const std::string& text, double low, double high) {
    const std::optional<glm::dvec3> rgb = parseRgb(text);
    if (!rgb) {
        throw UsageError(fmt::format("{} '{}'", option, text), "is not R,G,B or one number");
    }
    for (int channel = 0; channel < 3; ++channel) {
        const double value = (*rgb)[channel];
        if (!(value >= low && value <= high)) {
            throw UsageError(fmt::format("{} '{}'", option, text),
                             fmt::format("{} is {}, not in [{}, {}]", subedit::channelName(channel),
                                         value, low, high));
        }
    }
    return *rgb;
}

} // namespace celadon::app
