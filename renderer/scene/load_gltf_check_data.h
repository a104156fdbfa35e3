#pragma once

#include "renderer/scene/load_json.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The part of checkGltf() that is about bytes: buffer views and accessors, and what refers to
/// them.
namespace celadon::loaders {

/// Component types, as GL has them.
constexpr std::int64_t kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123;
constexpr std::int64_t kUnsignedInt = 5125, kFloat = 5126;

[[nodiscard]] bool isUnsigned(std::int64_t componentType);

struct CheckedAccessor {
    std::string type;
    std::int64_t componentType = 0;
    std::uint64_t count = 0;
    bool hasData = false; ///< from a buffer view; else zeros, with sparse values perhaps
};

struct CheckedData {
    std::size_t bufferViews = 0;
    std::vector<CheckedAccessor> accessors;
};

/// What an element must have. @throws InputError when it has not
template<typename T>
T required(const JsonElement& element, const char* name, std::optional<T> value) {
    if (!value) {
        element.fail(fmt::format("'{}' is missing", name));
    }
    return *value;
}

/// Elements of the array `name` of the root; 0 when there is none.
[[nodiscard]] std::size_t sizeOf(const JsonElement& root, const char* name);

/// Every view lies in its buffer, every accessor in its view.
/// @param bufferSizes bytes of each buffer @throws InputError
[[nodiscard]] CheckedData checkData(const JsonElement& root,
                                    std::span<const std::uint64_t> bufferSizes);

/// Meshes, morph targets and skins have accessors of the kinds that they need. @throws InputError
void checkMeshes(const JsonElement& root, const CheckedData& data);

} // namespace celadon::loaders
