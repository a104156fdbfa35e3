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

/// Hangs the roots of all scenes below nodes that scale them. Skins follow their joints.
void scaleScenes(json& root, double scale) {
    for (json& scene : root["scenes"]) {
        if (scene.contains("nodes")) {
            json& nodes = root["nodes"];
            nodes.push_back({{"name", "scale"},
                             {"scale", json::array({scale, scale, scale})},
                             {"children", scene["nodes"]}});
            scene["nodes"] = json::array({nodes.size() - 1});
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
    std::string buffer = joinBuffers(root, document);
    takeImages(root, document, buffer, leftBehind);
    for (const auto& [index, made] : changes.materials) {
        mergeGltfMaterial(root, index, made);
    }
    putDeformers(root, source, changes.deformers);
    if (changes.scale != 1.0) {
        scaleScenes(root, changes.scale);
    }
    writeGltfFile(std::move(root), buffer, target);
    return leftBehind;
}

} // namespace celadon::loaders
