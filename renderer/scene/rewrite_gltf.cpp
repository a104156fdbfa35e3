#include "renderer/scene/rewrite_gltf.h"

#include "renderer/scene/gltf_file.h"
#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/load_gltf_container.h"
#include "renderer/scene/load_gltf_document.h"
#include "renderer/scene/load_json.h"
#include "renderer/scene/load_uri.h"
#include "renderer/scene/merge_gltf_material.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <initializer_list>
#include <map>
#include <optional>
#include <utility>

namespace celadon::loaders {

using nlohmann::json;

namespace {

/// Of the kinds that glTF and its extensions have; null: none of them.
const char* mimeTypeOf(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        return "image/png";
    }
    if (bytes.starts_with("\xff\xd8\xff")) {
        return "image/jpeg";
    }
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) {
        return "image/webp";
    }
    return bytes.starts_with("\xabKTX 20\xbb") ? "image/ktx2" : nullptr;
}

/// A second, compressed copy of a view, with places in buffers of its own.
bool isCompression(const std::string& extension) {
    return extension == "EXT_meshopt_compression" || extension == "KHR_meshopt_compression";
}

void dropCompression(json& view) {
    if (view.contains("extensions") && view["extensions"].is_object()) {
        json& extensions = view["extensions"];
        for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            extensions.erase(name);
        }
        if (extensions.empty()) {
            view.erase("extensions");
        }
    }
}

/// All buffers one after the other.
std::string joinBuffers(json& root, const GltfDocument& document) {
    std::string joined;
    std::vector<std::size_t> begin;
    for (const std::string_view bytes : document.buffers) {
        joined.resize((joined.size() + 3) / 4 * 4, '\0');
        begin.push_back(joined.size());
        joined += bytes;
    }
    if (root.contains("bufferViews")) {
        for (json& view : root["bufferViews"]) {
            const auto buffer = view["buffer"].get<std::size_t>();
            view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + begin[buffer];
            view["buffer"] = 0;
            dropCompression(view);
        }
    }
    if (root.contains("extensionsUsed")) {
        std::erase_if(root["extensionsUsed"].get_ref<json::array_t&>(),
                      [](const json& name) { return isCompression(name.get<std::string>()); });
        if (root["extensionsUsed"].empty()) {
            root.erase("extensionsUsed");
        }
    }
    return joined;
}

/// Pictures that lie in files or in the JSON go into the buffer.
void takeImages(json& root, const GltfDocument& document, std::string& buffer,
                std::vector<std::string>& leftBehind) {
    for (std::size_t i = 0; i < document.images.size(); ++i) {
        const std::string& uri = document.images[i].uri;
        if (uri.empty()) {
            continue;
        }
        std::optional<std::string> bytes;
        if (isDataUri(uri)) {
            bytes = decodeDataUri(uri);
        } else if (const auto path = resolveUri(document.file, uri)) {
            try {
                bytes = readFile(*path);
            } catch (const InputError&) { // told below
            }
        }
        const char* const type = bytes ? mimeTypeOf(*bytes) : nullptr;
        if (type == nullptr && isDataUri(uri)) {
            continue; // it goes along as it is
        }
        if (type == nullptr) {
            leftBehind.push_back(fmt::format("picture '{}'", excerpt(uri)));
            continue;
        }
        json& image = root["images"][i];
        image.erase("uri");
        image["mimeType"] = type;
        image["bufferView"] = appendView(root, buffer, *bytes);
    }
}

void multiply(json& object, std::initializer_list<const char*> names, double scale) {
    for (const char* const name : names) {
        if (object.contains(name) && object[name].is_number()) {
            object[name] = scale * object[name].get<double>();
        }
    }
}

/// Each root of a scene hangs below a node of its own that scales it. Skins follow their joints;
/// numbers in cameras and lights are lengths as well.
void scaleScenes(json& root, double scale) {
    std::map<std::size_t, std::size_t> above; // root: the node above it
    json& nodes = root["nodes"];
    for (json& scene : root["scenes"]) {
        if (!scene.contains("nodes")) {
            continue;
        }
        for (json& node : scene["nodes"]) {
            const auto index = node.get<std::size_t>();
            const auto [place, isNew] = above.try_emplace(index, nodes.size());
            if (isNew) {
                nodes.push_back({{"name", "scale"},
                                 {"scale", json::array({scale, scale, scale})},
                                 {"children", json::array({index})}});
            }
            node = place->second;
        }
    }
    if (root.contains("cameras")) {
        for (json& camera : root["cameras"]) {
            if (camera.contains("orthographic")) {
                multiply(camera["orthographic"], {"xmag", "ymag", "znear", "zfar"}, scale);
            }
            if (camera.contains("perspective")) {
                multiply(camera["perspective"], {"znear", "zfar"}, scale);
            }
        }
    }
    const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (root.contains(lights)) {
        for (json& light : root[lights]) {
            multiply(light, {"range"}, scale);
        }
    }
}

/// Celadon shows all roots of a file without a scene; other programs need not.
void requireScene(json& root) {
    if (root.contains("scenes") || !root.contains("nodes")) {
        return;
    }
    std::vector<bool> isChild(root["nodes"].size(), false);
    for (const json& node : root["nodes"]) {
        for (const json& child : node.value("children", json::array())) {
            isChild[child.get<std::size_t>()] = true;
        }
    }
    json roots = json::array();
    for (std::size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) {
            roots.push_back(i);
        }
    }
    root["scenes"] = json::array({{{"nodes", roots}}});
    root["scene"] = 0;
}

/// The buffer of the new file must not take the place of one of the old file.
void checkBuffer(const json& root, const std::filesystem::path& source,
                 const std::filesystem::path& target) {
    if (target.extension() == ".glb" || !root.contains("buffers")) {
        return;
    }
    for (const json& buffer : root["buffers"]) {
        const std::string uri = buffer.value("uri", "");
        const auto path = isDataUri(uri) ? std::nullopt : resolveUri(source, uri);
        std::error_code ignored;
        if (!uri.empty() && path &&
            std::filesystem::equivalent(*path, bufferBeside(target), ignored)) {
            throw UsageError(
                quoted(target),
                fmt::format("its buffer would replace {} of the model", quoted(path->filename())),
                "choose another name, or a .glb");
        }
    }
}

} // namespace

std::vector<std::string> rewriteGltf(const std::filesystem::path& source,
                                     const GltfChanges& changes,
                                     const std::filesystem::path& target) {
    const std::string content = readFile(source);
    GltfDocument document;
    openGltf(source, content, document);
    json root = parseJson(source, splitContainer(source, content).json);
    std::vector<std::string> leftBehind;
    std::string buffer;
    try {
        checkBuffer(root, source, target);
        requireScene(root);
        buffer = joinBuffers(root, document);
        takeImages(root, document, buffer, leftBehind);
        for (const auto& [index, made] : changes.materials) {
            mergeGltfMaterial(root, index, made);
        }
        putDeformers(root, source, changes.deformers);
        if (changes.scale != 1.0) {
            scaleScenes(root, changes.scale);
        }
        if (changes.lights) {
            putLights(root, *changes.lights);
        }
    } catch (const json::exception& error) { // in what the loader does not look at
        throw InputError(quoted(source),
                         fmt::format("is not laid out as glTF 2.0 is ({})", error.what()),
                         "export the model again");
    }
    writeGltfFile(std::move(root), buffer, target);
    return leftBehind;
}

} // namespace celadon::loaders
