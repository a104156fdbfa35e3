#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// JSON from a stranger: parsed with bounds on its depth, and read member by member with messages
/// that say where.
namespace celadon::loaders {

inline constexpr int kMaxJsonDepth = 64;

/// @throws InputError with the line: not JSON, not an object, nested deeper than kMaxJsonDepth
[[nodiscard]] nlohmann::json parseJson(const std::filesystem::path& file, std::string_view text,
                                       const char* remedy = "export the model again");

/// An element of the document with its place, such as "accessor 3 'positions'". Members that are
/// absent give nothing; members of the wrong kind or out of range throw InputError.
class JsonElement {
public:
    /// @param remedy what to do where a member is wrong
    JsonElement(const std::filesystem::path& file, const nlohmann::json& value, std::string place,
                const char* remedy = "export the model again")
        : mFile(&file), mValue(&value), mPlace(std::move(place)), mRemedy(remedy) {}

    [[nodiscard]] const nlohmann::json& value() const { return *mValue; }

    [[nodiscard]] std::optional<std::int64_t> integer(const char* name, std::int64_t least,
                                                      std::int64_t most) const;
    /// An integer below `size`, the number of `what` in the file.
    [[nodiscard]] std::optional<std::size_t> index(const char* name, std::size_t size,
                                                   std::string_view what) const;
    [[nodiscard]] std::optional<double> number(const char* name) const; ///< finite
    [[nodiscard]] std::optional<std::string> string(const char* name) const;
    /// Finite numbers; exactly `count` of them unless that is 0.
    [[nodiscard]] std::optional<std::vector<double>> numbers(const char* name,
                                                             std::size_t count) const;
    /// Indices below `size`.
    [[nodiscard]] std::vector<std::size_t> indices(const char* name, std::size_t size,
                                                   std::string_view what) const;
    [[nodiscard]] std::optional<JsonElement> object(const char* name) const;
    /// The objects of an array, none when it is absent. `noun` names one: "accessor".
    [[nodiscard]] std::vector<JsonElement> objects(const char* name, std::string_view noun) const;

    /// object("extensions"), then the extension of that name.
    [[nodiscard]] std::optional<JsonElement> extension(const char* name) const;

    [[nodiscard]] std::string where() const;
    [[noreturn]] void fail(const std::string& reason) const { fail(reason, mRemedy); }
    [[noreturn]] void fail(const std::string& reason, const std::string& remedy) const;
    /// The same element, with another remedy for it and what is within.
    [[nodiscard]] JsonElement withRemedy(const char* remedy) const {
        return JsonElement(*mFile, *mValue, mPlace, remedy);
    }

private:
    const std::filesystem::path* mFile;
    const nlohmann::json* mValue;
    std::string mPlace;
    const char* mRemedy;

    [[nodiscard]] const nlohmann::json* find(const char* name) const;
};

} // namespace celadon::loaders
