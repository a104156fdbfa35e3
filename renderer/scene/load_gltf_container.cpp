#include "renderer/scene/load_gltf_container.h"

#include "renderer/scene/load_bytes.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace celadon::loaders {

namespace {

constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr const char* kDamaged = "the file is damaged or cut short: export it again";

std::uint32_t littleEndian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) {
        value = (value << 8) | static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
}

GltfContainer splitBinary(const std::filesystem::path& file, std::string_view content) {
    constexpr std::size_t kHeaderBytes = 12;
    constexpr std::size_t kChunkHeaderBytes = 8;
    const auto fail = [&](const std::string& reason) {
        throw InputError(quoted(file), reason, kDamaged);
    };
    if (content.size() < kHeaderBytes + kChunkHeaderBytes) {
        fail(fmt::format("its {} bytes cannot hold a binary glTF", content.size()));
    }
    const std::uint32_t version = littleEndian(content, 4);
    if (version != 2) {
        throw InputError(quoted(file), fmt::format("is binary glTF version {}, not 2", version),
                         "export it as glTF 2.0");
    }
    const std::uint32_t length = littleEndian(content, 8);
    if (length > content.size()) {
        fail(fmt::format("{} bytes are promised, {} are there", length, content.size()));
    }
    content = content.substr(0, length);
    GltfContainer container;
    std::size_t at = kHeaderBytes;
    for (int chunk = 0; content.size() - at >= kChunkHeaderBytes; ++chunk) {
        const std::uint32_t size = littleEndian(content, at);
        const std::uint32_t type = littleEndian(content, at + 4);
        at += kChunkHeaderBytes;
        if (size > content.size() - at) {
            fail(fmt::format("chunk {} has {} bytes, but {} follow", chunk, size,
                             content.size() - at));
        }
        if (chunk == 0 && type != kJsonChunk) {
            fail("its first chunk is not JSON");
        }
        if (chunk == 0) {
            container.json = content.substr(at, size);
        } else if (chunk == 1 && type == kBinaryChunk) {
            container.binary = content.substr(at, size);
        }
        at += size;
    }
    if (container.json.empty()) {
        fail("its JSON chunk is empty");
    }
    return container;
}

} // namespace

GltfContainer splitContainer(const std::filesystem::path& file, std::string_view content) {
    if (content.starts_with("glTF")) {
        return splitBinary(file, content);
    }
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (content.starts_with(kByteOrderMark)) {
        content.remove_prefix(kByteOrderMark.size());
    }
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || content[first] != '{') {
        throw InputError(quoted(file), "is neither JSON nor a binary glTF",
                         "check its format and extension");
    }
    return {content, std::nullopt};
}

} // namespace celadon::loaders
