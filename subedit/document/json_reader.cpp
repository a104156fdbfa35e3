#include "subedit/document/json_reader.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace celadon::subedit {

namespace {

using nlohmann::json;

/// What is there, short enough for a line.
std::string shown(const json& value) {
    constexpr std::size_t kLongest = 40;
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > kLongest) {
        text.resize(kLongest);
        text += "...";
    }
    return text;
}

/// RFC 6901: "~" and "/" in names are escaped.
std::string escaped(std::string_view name) {
    std::string text;
    for (const char c : name) {
        text += c == '~' ? "~0" : (c == '/' ? "~1" : std::string(1, c));
    }
    return text;
}

std::string inWords(const Limits& limits) {
    return fmt::format("{}{:g}, {:g}]", limits.excludesLeast ? '(' : '[', limits.least,
                       limits.most);
}

} // namespace

JsonReader::JsonReader(const std::string& subject, const json& value, std::string pointer)
    : mSubject(subject), mValue(value), mPointer(std::move(pointer)) {
    if (!value.is_object()) {
        failHere(fmt::format("is {}, not an object", shown(value)));
    }
}

bool JsonReader::has(const char* name) const {
    mAsked.insert(name);
    return mValue.contains(name);
}

const json& JsonReader::member(const char* name) const {
    mAsked.insert(name);
    const auto found = mValue.find(name);
    if (found == mValue.end()) {
        fail(name, "is missing");
    }
    return *found;
}

float JsonReader::checked(const json& value, const std::string& pointer,
                          const Limits& limits) const {
    if (!value.is_number()) {
        failAt(pointer, fmt::format("is {}, not a number", shown(value)));
    }
    const auto number = value.get<double>();
    // The least is checked after rounding too: 1e-60 is above 0, its float is not.
    const auto rounded = static_cast<float>(number);
    if (!std::isfinite(number) || number < limits.least || number > limits.most ||
        (limits.excludesLeast && static_cast<double>(rounded) <= limits.least)) {
        failAt(pointer, fmt::format("is {}, not in {}", shown(value), inWords(limits)));
    }
    return rounded;
}

float JsonReader::number(const char* name, const Limits& limits) const {
    const json& value = member(name);
    return checked(value, mPointer + '/' + name, limits);
}

float JsonReader::number(const char* name, const Limits& limits, float otherwise) const {
    return has(name) ? number(name, limits) : otherwise;
}

bool JsonReader::flag(const char* name, bool otherwise) const {
    if (!has(name)) {
        return otherwise;
    }
    const json& value = member(name);
    if (!value.is_boolean()) {
        fail(name, fmt::format("is {}, not true or false", shown(value)));
    }
    return value.get<bool>();
}

glm::vec3 JsonReader::vec3(const char* name, const Limits& limits) const {
    const json& value = member(name);
    if (!value.is_array() || value.size() != 3) {
        fail(name, fmt::format("is {}, not three numbers", shown(value)));
    }
    glm::vec3 result(0.0f);
    for (int c = 0; c < 3; ++c) {
        result[c] = checked(value[static_cast<std::size_t>(c)],
                            fmt::format("{}/{}/{}", mPointer, name, c), limits);
    }
    return result;
}

glm::vec2 JsonReader::vec2(const char* name, const Limits& limits) const {
    const json& value = member(name);
    if (!value.is_array() || value.size() != 2) {
        fail(name, fmt::format("is {}, not two numbers", shown(value)));
    }
    return {checked(value[0], fmt::format("{}/{}/0", mPointer, name), limits),
            checked(value[1], fmt::format("{}/{}/1", mPointer, name), limits)};
}

std::string JsonReader::text(const char* name) const {
    const json& value = member(name);
    if (!value.is_string()) {
        fail(name, fmt::format("is {}, not a text", shown(value)));
    }
    return value.get<std::string>();
}

std::size_t JsonReader::choice(const char* name, std::span<const std::string_view> choices,
                               std::string_view noun) const {
    const std::string word = text(name);
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (choices[i] == word) {
            return i;
        }
    }
    fail(name, fmt::format("{} is no {}", shown(member(name)), noun),
         fmt::format("known: {}", fmt::join(choices, ", ")));
}

JsonReader JsonReader::object(const char* name) const {
    return {mSubject, member(name), mPointer + '/' + name};
}

void JsonReader::forEach(const char* name,
                         const std::function<void(const json&, const std::string&)>& visit) const {
    const json& value = member(name);
    if (!value.is_array()) {
        fail(name, fmt::format("is {}, not a list", shown(value)));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        visit(value[i], fmt::format("{}/{}/{}", mPointer, name, i));
    }
}

void JsonReader::finish() const {
    for (const auto& [name, value] : mValue.items()) {
        if (mAsked.find(name) == mAsked.end()) {
            failAt(mPointer + '/' + escaped(name), "is an unknown field",
                   fmt::format("known here: {}", fmt::join(mAsked, ", ")));
        }
    }
}

void JsonReader::fail(const char* name, const std::string& reason,
                      const std::string& remedy) const {
    failAt(mPointer + '/' + name, reason, remedy);
}

void JsonReader::failHere(const std::string& reason, const std::string& remedy) const {
    failAt(mPointer, reason, remedy);
}

void JsonReader::failAt(const std::string& pointer, const std::string& reason,
                        const std::string& remedy) const {
    throw InputError(fmt::format("{}, {}", mSubject, pointer.empty() ? "the document" : pointer),
                     reason, remedy);
}

} // namespace celadon::subedit
