#pragma once

#include "app/argument.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <string_view>

/// What addOption() does with a value: each returns a function that parses it into a variable,
/// which must outlive the parsing.
namespace celadon::app {

/// One of the words, into an enum whose values stand in the same order.
template<typename Enum>
auto takeChoice(Enum& value, std::span<const std::string_view> words) {
    return [&value, words](const Argument& argument) {
        value = static_cast<Enum>(parseChoice(argument, words));
    };
}

template<typename Number>
auto takeNumber(Number& value, const NumberRange& range) {
    return [&value, range](const Argument& argument) { value = parseNumber(argument, range); };
}

template<typename Integer>
auto takeInteger(Integer& value, int least, int most) {
    return [&value, least, most](const Argument& argument) {
        value = parseInteger(argument, least, most);
    };
}

inline auto takeVector(std::optional<glm::dvec3>& value) {
    return [&value](const Argument& argument) { value = parseVector(argument); };
}

template<typename Text>
auto takeText(Text& value) {
    return [&value](const Argument& argument) { value = parseText(argument); };
}

} // namespace celadon::app
