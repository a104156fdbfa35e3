#include "renderer/scene/gltf_file.h"

#include "subedit/atomic_file.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <span>

namespace celadon::loaders {

using nlohmann::json;

namespace {

std::string littleEndian(std::size_t value) {
    std::string bytes;
    for (int k = 0; k < 4; ++k) {
        bytes += static_cast<char>(value >> (8 * k) & 0xff);
    }
    return bytes;
}

/// Chunks and views start on multiples of four.
void pad(std::string& bytes, char with) {
    bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

std::string textOf(const json& document, int indent) {
    return document.dump(indent, ' ', false, json::error_handler_t::replace);
}

/// What a URI may hold as it is (RFC 3986, unreserved); the rest is escaped.
std::string escaped(const std::string& name) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "0123456789-._~";
    std::string uri;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (kPlain.find(c) != std::string_view::npos) {
            uri.push_back(c);
        } else {
            uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
        }
    }
    return uri;
}

} // namespace

std::string binaryGltf(const json& document, std::optional<std::string_view> buffer) {
    std::string text = textOf(document, -1);
    pad(text, ' ');
    std::string chunks = littleEndian(text.size()) + "JSON" + text;
    if (buffer) {
        std::string bytes(*buffer);
        pad(bytes, '\0');
        chunks += littleEndian(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }
    constexpr std::size_t kHeaderBytes = 12;
    return "glTF" + littleEndian(2) + littleEndian(kHeaderBytes + chunks.size()) + chunks;
}

std::size_t appendView(json& document, std::string& buffer, std::string_view bytes) {
    pad(buffer, '\0');
    json& views = document["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer.append(bytes);
    return views.size() - 1;
}

void writeGltfFile(json document, const std::string& buffer, const std::filesystem::path& name) {
    const std::filesystem::path file = resolveTarget(name); // the buffer lies beside it
    document.erase("buffers");
    if (buffer.empty()) {
        writeFileAtomically(file, file.extension() == ".glb" ? binaryGltf(document, std::nullopt)
                                                             : textOf(document, 1) + "\n");
        return;
    }
    json only = {{"byteLength", buffer.size()}};
    if (file.extension() == ".glb") {
        document["buffers"] = json::array({only});
        writeFileAtomically(file, binaryGltf(document, buffer));
        return;
    }
    only["uri"] = escaped(bufferBeside(file).filename().string());
    document["buffers"] = json::array({only});
    AtomicFile bufferTarget(bufferBeside(file));
    AtomicFile target(file);
    bufferTarget.write(std::as_bytes(std::span(buffer)));
    const std::string text = textOf(document, 1) + "\n";
    target.write(std::as_bytes(std::span(text)));
    bufferTarget.commit();
    target.commit();
}

std::filesystem::path bufferBeside(const std::filesystem::path& file) {
    std::filesystem::path beside = file;
    return beside.replace_extension(".bin");
}

void checkGltfName(const std::filesystem::path& file) {
    if (file.extension() != ".gltf" && file.extension() != ".glb") {
        throw UsageError(fmt::format("'{}'", file.string()), "is no name of a glTF",
                         "let it end in .gltf or .glb");
    }
}

} // namespace celadon::loaders
