#include "renderer/scene/merge_gltf_material.h"

#include "subedit/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <optional>

namespace celadon::loaders {

using nlohmann::json;

namespace {

std::optional<std::size_t> toIndex(const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value)
                                                                    : std::nullopt;
}

/// Members of `made` replace or join those of `target`, objects member by member.
void mergeInto(json& target, const json& made) {
    for (const auto& [key, value] : made.items()) {
        if (value.is_object() && target.contains(key) && target[key].is_object()) {
            mergeInto(target[key], value);
        } else {
            target[key] = value;
        }
    }
}

/// A new factor is the whole color: a viewer would multiply it by the old picture. One that cuts
/// holes has to stay.
void dropColorTexture(json& material, const json& made) {
    if (made.contains(json::json_pointer("/pbrMetallicRoughness/baseColorFactor")) &&
        material.value("alphaMode", "OPAQUE") == "OPAQUE") {
        material["pbrMetallicRoughness"].erase("baseColorTexture");
    }
}

std::size_t materialCount(const json& document) {
    return document.contains("materials") ? document["materials"].size() : 0;
}

/// By index or name; nothing if there is none.
std::optional<std::size_t> findGltfMaterial(const json& document, const std::string& material) {
    const std::optional<std::size_t> index = toIndex(material);
    for (std::size_t i = 0; i < materialCount(document); ++i) {
        if (index ? i == *index : document["materials"][i].value("name", "") == material) {
            return i;
        }
    }
    return std::nullopt;
}

/// @return whether there was any
bool wearWhereNone(json& document, std::size_t material) {
    bool isWorn = false;
    if (!document.contains("meshes")) {
        return false;
    }
    for (json& mesh : document["meshes"]) {
        for (json& primitive : mesh["primitives"]) {
            if (!primitive.contains("material")) {
                primitive["material"] = material;
                isWorn = true;
            }
        }
    }
    return isWorn;
}

} // namespace

void mergeGltfMaterial(json& document, std::size_t material, const json& made) {
    const std::size_t count = materialCount(document);
    if (material < count) {
        json& target = document["materials"][material];
        const json name = target.value("name", made["name"]);
        mergeInto(target, made);
        dropColorTexture(target, made);
        target["name"] = name;
    } else if (wearWhereNone(document, count)) {
        document["materials"].push_back(made);
    } else {
        return;
    }
    const json extensions = made.value("extensions", json::object());
    for (const auto& [extension, value] : extensions.items()) {
        json& used = document["extensionsUsed"];
        if (std::find(used.begin(), used.end(), extension) == used.end()) {
            used.push_back(extension);
        }
    }
}

void mergeGltfMaterial(json& document, const std::string& file, const std::string& material,
                       const json& made) {
    const auto refuse = [&](const std::string& reason) {
        throw InputError(fmt::format("'{}'", file), reason);
    };
    try {
        if (document.at("asset").at("version") != "2.0") {
            refuse(fmt::format("is glTF {}, not 2.0", document["asset"]["version"].dump()));
        }
        const std::size_t count = materialCount(document);
        if (material.empty()) {
            for (std::size_t i = 0; i <= count; ++i) {
                mergeGltfMaterial(document, i, made);
            }
        } else if (const auto index = findGltfMaterial(document, material)) {
            mergeGltfMaterial(document, *index, made);
        } else {
            refuse(fmt::format("has no material '{}' among its {}", material, count));
        }
    } catch (const json::exception& error) {
        refuse(fmt::format("is not laid out as glTF 2.0 is ({})", error.what()));
    }
}

} // namespace celadon::loaders
