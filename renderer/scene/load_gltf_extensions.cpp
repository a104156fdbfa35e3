// What a glTF asks of its reader: its version, and extensions (load_gltf_check.h).
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace celadon::loaders {

namespace {

/// Extensions that a file may require of us.
constexpr std::array kSupported{"KHR_lights_punctual",   "KHR_texture_transform",
                                "KHR_mesh_quantization", "KHR_materials_ior",
                                "KHR_materials_unlit",   "KHR_materials_emissive_strength"};

/// Optional extensions that may be ignored without a word.
constexpr std::array kSilent{"KHR_draco_mesh_compression",
                             "EXT_meshopt_compression",
                             "KHR_materials_variants",
                             "KHR_xmp_json_ld",
                             "KHR_xmp",
                             "KHR_animation_pointer",
                             "KHR_node_visibility",
                             "MSFT_lod",
                             "EXT_texture_webp",
                             "KHR_texture_basisu"};

template<std::size_t N>
bool contains(const std::array<const char*, N>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> extensionNames(const JsonElement& root, const char* member) {
    std::vector<std::string> names;
    const auto found = root.value().find(member);
    if (found == root.value().end()) {
        return names;
    }
    for (const nlohmann::json& name : found->is_array() ? *found : nlohmann::json::array()) {
        if (name.is_string()) {
            names.push_back(excerpt(name.get_ref<const std::string&>()));
        }
    }
    return names;
}

/// Whether an extension only stands in for SubEdit materials, as in our own exports: whoever has it
/// names one in `extras.subedit`, which says more.
bool isStandIn(const JsonElement& root, const std::string& name) {
    if (name != "KHR_materials_volume" && name != "KHR_materials_diffuse_transmission") {
        return false;
    }
    const auto materials = root.value().find("materials");
    if (materials == root.value().end() || !materials->is_array()) {
        return false;
    }
    return std::ranges::all_of(*materials, [&](const nlohmann::json& material) {
        const auto holds = [&](const char* member, const std::string& key) {
            const auto found = material.find(member);
            return found != material.end() && found->is_object() && found->contains(key);
        };
        return !material.is_object() || !holds("extensions", name) || holds("extras", "subedit");
    });
}

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

} // namespace

void checkGltfVersion(const JsonElement& root) {
    const auto asset = root.object("asset");
    const std::string version = asset ? asset->string("version").value_or("") : "";
    if (version.empty()) {
        root.fail("does not say its version ('asset.version')", "is it a glTF? export it again");
    }
    const auto least = asset->string("minVersion");
    if (!version.starts_with("2.") || (least && *least != "2.0")) {
        root.fail(fmt::format("is glTF {}, not 2.0", excerpt(least ? *least : version)),
                  "export it as glTF 2.0");
    }
    std::vector<std::string> missing;
    for (const std::string& name : extensionNames(root, "extensionsRequired")) {
        if (!contains(kSupported, name)) {
            missing.push_back(name);
        }
    }
    if (missing.empty()) {
        return;
    }
    const std::string first = missing.front();
    const char* remedy = "export it without";
    if (first == "KHR_draco_mesh_compression") {
        remedy = "export it without Draco compression";
    } else if (first == "EXT_meshopt_compression") {
        remedy = "export it without meshopt compression";
    } else if (first == "KHR_texture_basisu") {
        remedy = "export it with PNG or JPEG pictures";
    }
    root.fail(fmt::format("requires {}, which Celadon does not have", joined(missing)), remedy);
}

std::vector<std::string> unsupportedExtensions(const JsonElement& root) {
    std::vector<std::string> ignored;
    for (const std::string& name : extensionNames(root, "extensionsUsed")) {
        if (!contains(kSupported, name) && !contains(kSilent, name) && !isStandIn(root, name)) {
            ignored.push_back(name);
        }
    }
    if (ignored.empty()) {
        return {};
    }
    return {fmt::format("{}: ignores {}", root.where(), joined(ignored))};
}

} // namespace celadon::loaders
