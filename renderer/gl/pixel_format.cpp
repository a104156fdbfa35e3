#include "renderer/gl/texture.h"

#include <algorithm>
#include <array>

namespace celadon::gl {

namespace {

struct Entry {
    GLenum internalFormat;
    const char* name;
    PixelFormat format;
};

constexpr PixelFormat floats(int channels, GLenum clientFormat, GLenum type, int bytes) {
    return {channels, clientFormat, type, false, false, bytes};
}
constexpr PixelFormat integers(int channels, GLenum clientFormat, GLenum type, int bytes) {
    return {channels, clientFormat, type, true, false, bytes};
}

constexpr std::array kFormats{
    Entry{GL_R8, "R8", floats(1, GL_RED, GL_UNSIGNED_BYTE, 1)},
    Entry{GL_RG8, "RG8", floats(2, GL_RG, GL_UNSIGNED_BYTE, 2)},
    Entry{GL_RGBA8, "RGBA8", floats(4, GL_RGBA, GL_UNSIGNED_BYTE, 4)},
    Entry{GL_SRGB8_ALPHA8, "SRGB8_ALPHA8", floats(4, GL_RGBA, GL_UNSIGNED_BYTE, 4)},
    Entry{GL_R16, "R16", floats(1, GL_RED, GL_UNSIGNED_SHORT, 2)},
    Entry{GL_RG16, "RG16", floats(2, GL_RG, GL_UNSIGNED_SHORT, 4)},
    Entry{GL_RGBA16, "RGBA16", floats(4, GL_RGBA, GL_UNSIGNED_SHORT, 8)},
    Entry{GL_R16F, "R16F", floats(1, GL_RED, GL_HALF_FLOAT, 2)},
    Entry{GL_RG16F, "RG16F", floats(2, GL_RG, GL_HALF_FLOAT, 4)},
    Entry{GL_RGB16F, "RGB16F", floats(3, GL_RGB, GL_HALF_FLOAT, 6)},
    Entry{GL_RGBA16F, "RGBA16F", floats(4, GL_RGBA, GL_HALF_FLOAT, 8)},
    Entry{GL_R32F, "R32F", floats(1, GL_RED, GL_FLOAT, 4)},
    Entry{GL_RG32F, "RG32F", floats(2, GL_RG, GL_FLOAT, 8)},
    Entry{GL_RGB32F, "RGB32F", floats(3, GL_RGB, GL_FLOAT, 12)},
    Entry{GL_RGBA32F, "RGBA32F", floats(4, GL_RGBA, GL_FLOAT, 16)},
    Entry{GL_R11F_G11F_B10F, "R11F_G11F_B10F", floats(3, GL_RGB, GL_FLOAT, 4)},
    Entry{GL_R8UI, "R8UI", integers(1, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1)},
    Entry{GL_R16UI, "R16UI", integers(1, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2)},
    Entry{GL_R32UI, "R32UI", integers(1, GL_RED_INTEGER, GL_UNSIGNED_INT, 4)},
    Entry{GL_RG32UI, "RG32UI", integers(2, GL_RG_INTEGER, GL_UNSIGNED_INT, 8)},
    Entry{GL_RGBA32UI, "RGBA32UI", integers(4, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16)},
    Entry{GL_R32I, "R32I", integers(1, GL_RED_INTEGER, GL_INT, 4)},
    Entry{GL_RG32I, "RG32I", integers(2, GL_RG_INTEGER, GL_INT, 8)},
    Entry{GL_RGBA32I, "RGBA32I", integers(4, GL_RGBA_INTEGER, GL_INT, 16)},
    Entry{GL_DEPTH_COMPONENT24, "DEPTH_COMPONENT24",
          PixelFormat{1, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, false, true, 4}},
    Entry{GL_DEPTH_COMPONENT32F, "DEPTH_COMPONENT32F",
          PixelFormat{1, GL_DEPTH_COMPONENT, GL_FLOAT, false, true, 4}},
};

const Entry* findEntry(GLenum internalFormat) {
    const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const Entry& entry) {
        return entry.internalFormat == internalFormat;
    });
    return found != kFormats.end() ? &*found : nullptr;
}

} // namespace

PixelFormat pixelFormat(GLenum internalFormat) {
    const Entry* const entry = findEntry(internalFormat);
    CELADON_ASSERT(entry != nullptr);
    return entry != nullptr ? entry->format : PixelFormat{};
}

const char* formatName(GLenum internalFormat) {
    const Entry* const entry = findEntry(internalFormat);
    return entry != nullptr ? entry->name : "unknown format";
}

} // namespace celadon::gl
