#include "renderer/scene/load_json.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace celadon::loaders {

namespace {

std::string lineAt(const std::filesystem::path& file, std::string_view text, std::size_t offset) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
    return fmt::format("{}, line {}", quoted(file), 1 + std::count(text.begin(), end, '\n'));
}

/// tinygltf descends into extensions and extras by recursion: bound it before anybody parses.
void checkDepth(const std::filesystem::path& file, std::string_view text, const char* remedy) {
    int depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            i += c == '\\' ? 1 : 0;
            inString = c != '"';
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth) {
                throw InputError(lineAt(file, text, i),
                                 fmt::format("JSON nested deeper than {}", kMaxJsonDepth), remedy);
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

} // namespace

nlohmann::json parseJson(const std::filesystem::path& file, std::string_view text,
                         const char* remedy) {
    checkDepth(file, text, remedy);
    try {
        nlohmann::json json = nlohmann::json::parse(text);
        if (!json.is_object()) {
            throw InputError(quoted(file), "its JSON is not an object", remedy);
        }
        return json;
    } catch (const nlohmann::json::parse_error& error) {
        throw InputError(lineAt(file, text, error.byte), "is not valid JSON here",
                         fmt::format("is the file damaged or cut short? {}", remedy));
    } catch (const nlohmann::json::exception&) { // a number beyond double
        throw InputError(quoted(file), "its JSON holds a number out of range", remedy);
    }
}

std::string JsonElement::where() const {
    return mPlace.empty() ? quoted(*mFile) : quoted(*mFile) + ", " + mPlace;
}

void JsonElement::fail(const std::string& reason, const std::string& remedy) const {
    throw InputError(where(), reason, remedy);
}

const nlohmann::json* JsonElement::find(const char* name) const {
    const auto found = mValue->find(name);
    return found == mValue->end() ? nullptr : &*found;
}

std::optional<std::int64_t> JsonElement::integer(const char* name, std::int64_t least,
                                                 std::int64_t most) const {
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return std::nullopt;
    }
    if (!member->is_number_integer()) {
        fail(fmt::format("'{}' is not a whole number", name));
    }
    const bool tooLarge = member->is_number_unsigned() &&
                          member->get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
    const std::int64_t value = tooLarge ? INT64_MAX : member->get<std::int64_t>();
    if (tooLarge || value < least || value > most) {
        fail(most == INT64_MAX
                 ? fmt::format("'{}' is {}, below {}", name, member->dump(), least)
                 : fmt::format("'{}' is {}, outside {} ... {}", name, member->dump(), least, most));
    }
    return value;
}

std::optional<std::size_t> JsonElement::index(const char* name, std::size_t size,
                                              std::string_view what) const {
    const auto value = integer(name, INT64_MIN, INT64_MAX);
    if (!value) {
        return std::nullopt;
    }
    if (*value < 0 || static_cast<std::uint64_t>(*value) >= size) {
        fail(fmt::format("'{}' is {}, but the file has {}", name, *value, counted(size, what)));
    }
    return static_cast<std::size_t>(*value);
}

std::optional<double> JsonElement::number(const char* name) const {
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return std::nullopt;
    }
    if (!member->is_number() || !std::isfinite(member->get<double>())) {
        fail(fmt::format("'{}' is not a finite number", name));
    }
    return member->get<double>();
}

std::optional<std::string> JsonElement::string(const char* name) const {
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return std::nullopt;
    }
    if (!member->is_string()) {
        fail(fmt::format("'{}' is not a string", name));
    }
    return member->get<std::string>();
}

std::optional<std::vector<double>> JsonElement::numbers(const char* name, std::size_t count) const {
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return std::nullopt;
    }
    std::vector<double> result;
    if (!member->is_array() || (count != 0 && member->size() != count)) {
        fail(count == 0 ? fmt::format("'{}' is not an array of numbers", name)
                        : fmt::format("'{}' is not an array of {} numbers", name, count));
    }
    for (const nlohmann::json& item : *member) {
        if (!item.is_number() || !(std::abs(item.get<double>()) <=
                                   static_cast<double>(std::numeric_limits<float>::max()))) {
            fail(fmt::format("'{}' holds something other than finite numbers", name));
        }
        result.push_back(item.get<double>());
    }
    return result;
}

std::vector<std::size_t> JsonElement::indices(const char* name, std::size_t size,
                                              std::string_view what) const {
    std::vector<std::size_t> result;
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return result;
    }
    if (!member->is_array()) {
        fail(fmt::format("'{}' is not an array", name));
    }
    for (const nlohmann::json& item : *member) {
        if (!item.is_number_unsigned() || item.get<std::uint64_t>() >= size) {
            fail(fmt::format("'{}' holds {}, but the file has {}", name, excerpt(item.dump()),
                             counted(size, what)));
        }
        result.push_back(item.get<std::size_t>());
    }
    return result;
}

std::optional<JsonElement> JsonElement::object(const char* name) const {
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return std::nullopt;
    }
    if (!member->is_object()) {
        fail(fmt::format("'{}' is not an object", name));
    }
    return JsonElement(*mFile, *member, mPlace.empty() ? name : mPlace + ", " + name, mRemedy);
}

std::vector<JsonElement> JsonElement::objects(const char* name, std::string_view noun) const {
    std::vector<JsonElement> result;
    const nlohmann::json* const member = find(name);
    if (member == nullptr) {
        return result;
    }
    if (!member->is_array()) {
        fail(fmt::format("'{}' is not an array", name));
    }
    result.reserve(member->size());
    for (const nlohmann::json& item : *member) {
        std::string place = mPlace.empty() ? "" : mPlace + ", ";
        place += fmt::format("{} {}", noun, result.size());
        if (!item.is_object()) {
            throw InputError(quoted(*mFile) + ", " + place, "is not an object", mRemedy);
        }
        const auto itsName = item.find("name");
        if (itsName != item.end() && itsName->is_string()) {
            place += fmt::format(" '{}'", excerpt(itsName->get_ref<const std::string&>()));
        }
        result.emplace_back(*mFile, item, std::move(place), mRemedy);
    }
    return result;
}

std::optional<JsonElement> JsonElement::extension(const char* name) const {
    const auto all = object("extensions");
    return all ? all->object(name) : std::nullopt;
}

} // namespace celadon::loaders
