#include "app/argument.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace celadon::app {
namespace {

constexpr int kMostFrames = 9'999'999;

UsageError unfit(const Argument& argument, const std::string& reason, const std::string& remedy) {
    return {fmt::format("{} '{}'", argument.option, argument.text), reason, remedy};
}

/// The whole text as a number; a leading '+' is allowed, as people write it.
template<typename T>
std::optional<T> convert(std::string_view text) {
    if (text.starts_with('+') && text.size() > 1 && text[1] != '-') {
        text.remove_prefix(1);
    }
    T value{};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (text.empty() || error != std::errc() || rest != end) {
        return std::nullopt;
    }
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) {
            return parts;
        }
        begin = end + 1;
    }
}

std::string describe(const NumberRange& range) {
    const bool hasLeast = range.least > std::numeric_limits<double>::lowest();
    const bool hasMost = range.most < std::numeric_limits<double>::max();
    const char* above = range.excludesLeast ? "above" : "at least";
    if (hasLeast && hasMost) {
        return fmt::format("a number {} {} and at most {}", above, range.least, range.most);
    }
    if (hasLeast) {
        return fmt::format("a number {} {}", above, range.least);
    }
    if (hasMost) {
        return fmt::format("a number of at most {}", range.most);
    }
    return "a number";
}

bool contains(const NumberRange& range, double value) {
    return value <= range.most &&
           (range.excludesLeast ? value > range.least : value >= range.least);
}

std::optional<double> convertFinite(std::string_view text) {
    const std::optional<double> value = convert<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace

double parseNumber(const Argument& argument, const NumberRange& range) {
    const std::optional<double> value = convertFinite(argument.text);
    if (!value) {
        throw unfit(argument, "is not a number", "give " + describe(range));
    }
    if (!contains(range, *value)) {
        throw unfit(argument, "is out of range", "give " + describe(range));
    }
    return *value;
}

int parseInteger(const Argument& argument, int least, int most) {
    const std::optional<int> value = convert<int>(argument.text);
    const std::string remedy = fmt::format("give a whole number from {} to {}", least, most);
    if (!value) {
        throw unfit(argument, "is not a whole number in range", remedy);
    }
    if (*value < least || *value > most) {
        throw unfit(argument, "is out of range", remedy);
    }
    return *value;
}

glm::dvec3 parseVector(const Argument& argument, const NumberRange& range) {
    const std::vector<std::string_view> parts = split(argument.text, ',');
    if (parts.size() != 3) {
        throw unfit(argument, fmt::format("has {} parts, not three", parts.size()),
                    "give three numbers with commas between and no spaces, such as 0,1,0");
    }
    glm::dvec3 result;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = convertFinite(parts[i]);
        if (!value || !contains(range, *value)) {
            throw unfit(argument, fmt::format("'{}' does not do", parts[i]),
                        "each part is " + describe(range));
        }
        result[static_cast<int>(i)] = *value;
    }
    return result;
}

glm::ivec2 parseSize(const Argument& argument, int maxSide, long long maxPixels) {
    const std::vector<std::string_view> parts = split(argument.text, 'x');
    const std::optional<int> width = convert<int>(parts.front());
    const std::optional<int> height = parts.size() == 2 ? convert<int>(parts[1]) : std::nullopt;
    if (!width || !height) {
        throw unfit(argument, "is no picture size", "give WIDTHxHEIGHT in pixels, such as 800x600");
    }
    if (*width < 1 || *width > maxSide || *height < 1 || *height > maxSide) {
        throw unfit(argument, "is out of range",
                    fmt::format("each side has 1 to {} pixels", maxSide));
    }
    if (static_cast<long long>(*width) * *height > maxPixels) {
        throw unfit(argument, "is too large a picture",
                    fmt::format("at most {} pixels in all", maxPixels));
    }
    return {*width, *height};
}

std::string parseText(const Argument& argument) {
    if (argument.text.empty()) {
        throw UsageError(argument.option, "its value is empty");
    }
    if (argument.text.starts_with("--")) {
        throw UsageError(argument.option,
                         fmt::format("a value is missing before '{}'", argument.text));
    }
    return argument.text;
}

std::filesystem::path parsePath(const Argument& argument) {
    return parseText(argument);
}

std::size_t parseChoice(const Argument& argument, std::span<const std::string_view> choices) {
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (argument.text == choices[i]) {
            return i;
        }
    }
    throw unfit(argument, "is unknown", fmt::format("choose {}", fmt::join(choices, ", ")));
}

FrameRange parseFrames(const Argument& argument) {
    const std::vector<std::string_view> parts = split(argument.text, ':');
    const std::optional<int> first = convert<int>(parts.front());
    const std::optional<int> last = parts.size() == 2 ? convert<int>(parts[1]) : first;
    if (!first || !last || parts.size() > 2) {
        throw unfit(argument, "is no range of frames", "give FIRST:LAST, such as 1:24");
    }
    if (*first < 0 || *last < *first || *last > kMostFrames) {
        throw unfit(argument, "is out of range",
                    fmt::format("frames count up from 0 to at most {}", kMostFrames));
    }
    return {*first, *last};
}

LevelCounts parseLevels(const Argument& argument, int most) {
    const std::vector<std::string_view> parts = split(argument.text, ',');
    const std::optional<int> irradiance = convert<int>(parts.front());
    const std::optional<int> splatting = parts.size() == 2 ? convert<int>(parts[1]) : irradiance;
    if (!irradiance || !splatting || parts.size() > 2) {
        throw unfit(argument, "is no level count", "give N or IRRADIANCE,SPLATTING, such as 6,5");
    }
    if (*irradiance < 1 || *irradiance > most || *splatting < 1 || *splatting > most) {
        throw unfit(argument, "is out of range", fmt::format("give 1 to {} levels", most));
    }
    return {*irradiance, *splatting};
}

} // namespace celadon::app
