#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

/// An object of a JSON document from a stranger, read member by member. Every complaint names the
/// member by its JSON pointer, what is there and what would do; members that nobody asked for are
/// complaints too, so that a slip of the pen is not taken for a default.
namespace celadon::subedit {

struct Limits {
    double least;
    double most;
    bool excludesLeast = false;
};

class JsonReader {
public:
    /// @throws InputError unless `value` is an object
    JsonReader(const std::string& subject, const nlohmann::json& value, std::string pointer);

    [[nodiscard]] bool has(const char* name) const;
    [[nodiscard]] float number(const char* name, const Limits& limits) const;
    [[nodiscard]] float number(const char* name, const Limits& limits, float otherwise) const;
    [[nodiscard]] bool flag(const char* name, bool otherwise) const;
    [[nodiscard]] glm::vec3 vec3(const char* name, const Limits& limits) const;
    [[nodiscard]] glm::vec2 vec2(const char* name, const Limits& limits) const;
    [[nodiscard]] std::string text(const char* name) const;
    /// The index of a member's text among the choices.
    [[nodiscard]] std::size_t choice(const char* name, std::span<const std::string_view> choices,
                                     std::string_view noun) const;
    [[nodiscard]] JsonReader object(const char* name) const;
    /// Calls visit(element, its pointer) for each element of an array.
    void forEach(const char* name,
                 const std::function<void(const nlohmann::json&, const std::string&)>& visit) const;

    /// All members have been asked for. Call it last.
    void finish() const;

    [[noreturn]] void fail(const char* member, const std::string& reason,
                           const std::string& remedy = {}) const;
    [[noreturn]] void failHere(const std::string& reason, const std::string& remedy = {}) const;

    [[nodiscard]] const std::string& subject() const { return mSubject; }
    [[nodiscard]] const std::string& pointer() const { return mPointer; }

private:
    [[nodiscard]] const nlohmann::json& member(const char* name) const;
    [[nodiscard]] float checked(const nlohmann::json& value, const std::string& pointer,
                                const Limits& limits) const;
    [[noreturn]] void failAt(const std::string& pointer, const std::string& reason,
                             const std::string& remedy = {}) const;

    const std::string& mSubject;
    const nlohmann::json& mValue;
    std::string mPointer;
    mutable std::set<std::string, std::less<>> mAsked;
};

} // namespace celadon::subedit
