#include "renderer/scene/load_gltf_document.h"

#include "renderer/scene/load_bytes.h"
#include "renderer/scene/load_deformers.h"
#include "renderer/scene/load_gltf_animation.h"
#include "renderer/scene/load_gltf_check.h"
#include "renderer/scene/load_gltf_container.h"
#include "renderer/scene/load_json.h"
#include "renderer/scene/load_uri.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <exception>
#include <map>
#include <utility>

namespace celadon::loaders {

namespace {

std::uint64_t byteLengthOf(const JsonElement& buffer) {
    const auto length = buffer.integer("byteLength", 1, static_cast<std::int64_t>(kMaxFileBytes));
    if (!length) {
        buffer.fail("'byteLength' is missing");
    }
    return static_cast<std::uint64_t>(*length);
}

/// Finds the bytes of every buffer: in the file, beside it, or within its JSON.
void resolveBuffers(const JsonElement& root, const GltfContainer& container,
                    GltfDocument& document) {
    const std::vector<JsonElement> buffers = root.objects("buffers", "buffer");
    document.storage.reserve(buffers.size()); // so that views into it stay
    std::map<std::string, std::string_view> seen;
    std::uint64_t total = 0;
    for (const JsonElement& buffer : buffers) {
        const std::uint64_t wanted = byteLengthOf(buffer);
        const auto uri = buffer.string("uri");
        std::string_view bytes;
        if (!uri) {
            const bool isFirst = document.buffers.empty();
            if (!isFirst || !container.binary) {
                buffer.fail("has no 'uri'", isFirst ? "is it a .glb that lost its binary part?"
                                                    : "export the model again");
            }
            bytes = *container.binary;
        } else if (const auto known = seen.find(*uri); known != seen.end()) {
            bytes = known->second;
        } else {
            std::string content;
            if (isDataUri(*uri)) {
                auto decoded = decodeDataUri(*uri);
                if (!decoded) {
                    buffer.fail("its data URI is not valid base64");
                }
                content = std::move(*decoded);
            } else {
                const auto path = resolveUri(document.file, *uri);
                if (!path) {
                    buffer.fail(fmt::format("its uri '{}' is not a relative path", excerpt(*uri)),
                                "put the file beside the model and name it relative to it");
                }
                content = readFile(*path);
            }
            total += content.size();
            if (total > kMaxFileBytes) {
                buffer.fail(fmt::format("the buffers exceed {} bytes", kMaxFileBytes),
                            "split or simplify the model");
            }
            document.storage.push_back(std::move(content));
            bytes = document.storage.back();
            seen.emplace(*uri, bytes);
        }
        if (bytes.size() < wanted) {
            buffer.fail(fmt::format("{} bytes are promised, {} are there", wanted, bytes.size()),
                        "the file is damaged or cut short: export it again");
        }
        document.buffers.push_back(bytes.substr(0, wanted));
    }
}

void listImages(const JsonElement& root, GltfDocument& document) {
    for (const JsonElement& image : root.objects("images", "image")) {
        GltfImage result;
        result.name = excerpt(image.value().value("name", nlohmann::json()).is_string()
                                  ? image.value()["name"].get<std::string>()
                                  : "");
        result.uri = image.string("uri").value_or("");
        const auto view = image.value().find("bufferView");
        if (view != image.value().end()) {
            result.bufferView = view->get<std::size_t>(); // checked
        }
        document.images.push_back(std::move(result));
    }
}

/// Of scenes[scene].extras.celadon; extras of other shapes are somebody else's.
DeformerStack listDeformers(const JsonElement& root) {
    const std::vector<JsonElement> scenes = root.objects("scenes", "scene");
    const auto index = root.index("scene", scenes.size(), "scene").value_or(0);
    if (index >= scenes.size()) {
        return {};
    }
    const auto extras = scenes[index].value().find("extras");
    if (extras == scenes[index].value().end() || !extras->is_object() ||
        !extras->contains("celadon")) {
        return {};
    }
    return deformersOf(*scenes[index].object("extras")->object("celadon"));
}

/// Keeps what we read, so that nothing else can trip tinygltf.
std::string essentialJson(nlohmann::json& json) {
    nlohmann::json none = nlohmann::json::array();
    for (const char* const name : {"buffers", "images", "animations", "extras"}) {
        json.erase(name);
    }
    // glTF lets them be left out, for identities; tinygltf does not, but takes -1.
    for (nlohmann::json& skin : json.contains("skins") ? json["skins"] : none) {
        if (!skin.contains("inverseBindMatrices")) {
            skin["inverseBindMatrices"] = -1;
        }
    }
    return json.dump();
}

} // namespace

std::string_view GltfDocument::bytesOf(std::size_t bufferView) const {
    const tinygltf::BufferView& view = model.bufferViews[bufferView];
    return buffers[static_cast<std::size_t>(view.buffer)].substr(view.byteOffset, view.byteLength);
}

void openGltf(const std::filesystem::path& file, std::string_view content, GltfDocument& document) {
    document.file = file;
    const GltfContainer container = splitContainer(file, content);
    nlohmann::json json = parseJson(file, container.json);
    const JsonElement root(file, json, "");
    checkGltfVersion(root);
    document.warnings = unsupportedExtensions(root);
    resolveBuffers(root, container, document);
    std::vector<std::uint64_t> sizes;
    for (const std::string_view buffer : document.buffers) {
        sizes.push_back(buffer.size());
    }
    checkGltf(root, sizes);
    listImages(root, document);
    document.animations = listAnimations(root);
    document.deformers = listDeformers(root);

    const std::string essential = essentialJson(json);
    json = nullptr;
    std::string error;
    std::string ignored;
    bool done = false;
    try {
        tinygltf::TinyGLTF reader;
        done = reader.LoadASCIIFromString(&document.model, &error, &ignored, essential.data(),
                                          static_cast<unsigned int>(essential.size()), "");
    } catch (const std::exception& exception) {
        error = exception.what();
    }
    if (!done) {
        throw InputError(quoted(file),
                         fmt::format("tinygltf refuses it ({})",
                                     excerpt(error.substr(0, error.find('\n')), 120)),
                         "export it again");
    }
}

} // namespace celadon::loaders
