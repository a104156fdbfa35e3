#include "renderer/gl/texture.h"

#include "renderer/gl/debug.h"
#include "subedit/errors.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <bit>

namespace celadon::gl {

namespace {

/// Rows without padding, from the first texel, from client memory: whatever was left set.
void resetUnpack() {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                              GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES}) {
        glPixelStorei(name, 0);
    }
}

void resetPack() {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_PIXELS,
                              GL_PACK_SKIP_ROWS, GL_PACK_SKIP_IMAGES, GL_PACK_SWAP_BYTES}) {
        glPixelStorei(name, 0);
    }
}

GLint limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

/// Largest width, height and depth of a target.
glm::ivec3 largestSize(GLenum target) {
    switch (target) {
    case GL_TEXTURE_3D:
        return glm::ivec3(limit(GL_MAX_3D_TEXTURE_SIZE));
    case GL_TEXTURE_2D_ARRAY:
        return {glm::ivec2(limit(GL_MAX_TEXTURE_SIZE)), limit(GL_MAX_ARRAY_TEXTURE_LAYERS)};
    default:
        return {glm::ivec2(limit(GL_MAX_TEXTURE_SIZE)), 1};
    }
}

GLuint createTexture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return id;
}

std::size_t count(glm::ivec3 extent) {
    return static_cast<std::size_t>(extent.x) * static_cast<std::size_t>(extent.y) *
           static_cast<std::size_t>(extent.z);
}

} // namespace

int fullLevelCount(glm::ivec2 size) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({size.x, size.y, 1}))));
}

Texture Texture::make2d(std::string_view label, GLenum internalFormat, glm::ivec2 size,
                        int levels) {
    return make(label, GL_TEXTURE_2D, internalFormat, glm::ivec3(size, 1), levels);
}

Texture Texture::makeArray(std::string_view label, GLenum internalFormat, glm::ivec2 size,
                           int layers, int levels) {
    return make(label, GL_TEXTURE_2D_ARRAY, internalFormat, glm::ivec3(size, layers), levels);
}

Texture Texture::make3d(std::string_view label, GLenum internalFormat, glm::ivec3 size,
                        int levels) {
    return make(label, GL_TEXTURE_3D, internalFormat, size, levels);
}

Texture Texture::makeMultisampled(std::string_view label, GLenum internalFormat, glm::ivec2 size,
                                  int samples) {
    return make(label, GL_TEXTURE_2D_MULTISAMPLE, internalFormat, glm::ivec3(size, 1), 1, samples);
}

bool Texture::canMakeArray(GLenum internalFormat, glm::ivec2 size, int layers) {
    constexpr GLenum kProxy = GL_PROXY_TEXTURE_2D_ARRAY;
    const glm::ivec3 largest = largestSize(GL_TEXTURE_2D_ARRAY);
    if (size.x > largest.x || size.y > largest.y || layers > largest.z) {
        return false;
    }
    const PixelFormat format = pixelFormat(internalFormat);
    glTexImage3D(kProxy, 0, static_cast<GLint>(internalFormat), size.x, size.y, layers, 0,
                 format.clientFormat, format.nativeType, nullptr);
    GLint width = 0;
    glGetTexLevelParameteriv(kProxy, 0, GL_TEXTURE_WIDTH, &width);
    return width == size.x;
}

Texture Texture::make(std::string_view label, GLenum target, GLenum internalFormat, glm::ivec3 size,
                      int levels, int samples) {
    CELADON_ASSERT(size.x > 0 && size.y > 0 && size.z > 0 && levels > 0);
    const glm::ivec3 largest = largestSize(target);
    const auto fail = [&](const std::string& reason) {
        throw ContextError(fmt::format("GL texture '{}' of {}x{}x{} {}", label, size.x, size.y,
                                       size.z, formatName(internalFormat)),
                           reason);
    };
    if (size.x > largest.x || size.y > largest.y || size.z > largest.z) {
        fail(fmt::format("the driver allows {}x{}x{}", largest.x, largest.y, largest.z));
    }
    Texture texture;
    texture.mHandle = Handle<Traits>(createTexture(target));
    texture.mLabel = label;
    texture.mTarget = target;
    texture.mFormat = internalFormat;
    texture.mSize = size;
    texture.mLevels = levels;
    labelObject(GL_TEXTURE, texture.id(), label);
    if (target == GL_TEXTURE_2D_MULTISAMPLE) {
        glTextureStorage2DMultisample(texture.id(), samples, internalFormat, size.x, size.y,
                                      GL_TRUE);
    } else if (target == GL_TEXTURE_2D) {
        glTextureStorage2D(texture.id(), levels, internalFormat, size.x, size.y);
    } else {
        glTextureStorage3D(texture.id(), levels, internalFormat, size.x, size.y, size.z);
    }
    GLint immutable = GL_FALSE;
    glGetTextureParameteriv(texture.id(), GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    if (immutable == GL_FALSE) {
        const double bytes = static_cast<double>(count(size)) *
                             static_cast<double>(pixelFormat(internalFormat).bytesPerTexel);
        fail(fmt::format("the driver refuses its storage ({:.0f} MB)", bytes / 1e6));
    }
    if (target != GL_TEXTURE_2D_MULTISAMPLE) { // has no such parameters
        texture.applyDefaultSampling();
    }
    return texture;
}

void Texture::applyDefaultSampling() {
    // Formats of integers are incomplete with any filter but the nearest.
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER,
                        mLevels > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(id(), axis, GL_CLAMP_TO_EDGE);
    }
}

Texture Texture::viewLevels(std::string_view label, int firstLevel, int levels) const {
    CELADON_ASSERT(firstLevel >= 0 && levels > 0 && firstLevel + levels <= mLevels);
    const int layers = mTarget == GL_TEXTURE_2D_ARRAY ? mSize.z : 1;
    return view(label, mTarget, firstLevel, levels, 0, layers);
}

Texture Texture::viewLayer(std::string_view label, int layer) const {
    CELADON_ASSERT(mTarget == GL_TEXTURE_2D_ARRAY && layer >= 0 && layer < mSize.z);
    return view(label, GL_TEXTURE_2D, 0, mLevels, layer, 1);
}

Texture Texture::view(std::string_view label, GLenum target, int firstLevel, int levels,
                      int firstLayer, int layers) const {
    GLuint viewId = 0;
    glGenTextures(1, &viewId); // glTextureView wants a name that has no target yet
    Texture texture;
    texture.mHandle = Handle<Traits>(viewId);
    glTextureView(viewId, target, id(), mFormat, static_cast<GLuint>(firstLevel),
                  static_cast<GLuint>(levels), static_cast<GLuint>(firstLayer),
                  static_cast<GLuint>(layers));
    texture.mLabel = label;
    texture.mTarget = target;
    texture.mFormat = mFormat;
    texture.mSize = size(firstLevel);
    if (target != mTarget) {
        texture.mSize.z = 1;
    }
    texture.mLevels = levels;
    labelObject(GL_TEXTURE, viewId, label);
    texture.applyDefaultSampling();
    return texture;
}

int Texture::samples() const {
    GLint samples = 0;
    glGetTextureLevelParameteriv(id(), 0, GL_TEXTURE_SAMPLES, &samples);
    return std::max(samples, 1);
}

glm::ivec3 Texture::size(int level) const {
    CELADON_ASSERT(level >= 0 && level < mLevels);
    glm::ivec3 size = glm::max(mSize >> level, glm::ivec3(1));
    if (mTarget == GL_TEXTURE_2D_ARRAY) {
        size.z = mSize.z;
    }
    return size;
}

std::size_t Texture::texelCount(int level) const {
    return count(size(level));
}

void Texture::uploadBytes(int level, glm::ivec3 offset, glm::ivec3 extent, GLenum type,
                          const void* data, std::size_t elements) {
    const PixelFormat pixel = pixelFormat(mFormat);
    CELADON_ASSERT(elements == count(extent) * static_cast<std::size_t>(pixel.channels));
    CELADON_ASSERT(glm::all(glm::lessThanEqual(offset + extent, size(level))));
    static_cast<void>(elements);
    resetUnpack();
    if (mTarget == GL_TEXTURE_2D) {
        glTextureSubImage2D(id(), level, offset.x, offset.y, extent.x, extent.y, pixel.clientFormat,
                            type, data);
    } else {
        glTextureSubImage3D(id(), level, offset.x, offset.y, offset.z, extent.x, extent.y, extent.z,
                            pixel.clientFormat, type, data);
    }
}

void Texture::upload(int level, std::span<const float> texels) {
    uploadRegion(level, glm::ivec3(0), size(level), texels);
}

void Texture::upload(int level, std::span<const std::uint8_t> texels) {
    uploadRegion(level, glm::ivec3(0), size(level), texels);
}

void Texture::upload(int level, std::span<const std::uint16_t> texels) {
    uploadRegion(level, glm::ivec3(0), size(level), texels);
}

void Texture::upload(int level, std::span<const std::uint32_t> texels) {
    uploadBytes(level, glm::ivec3(0), size(level), GL_UNSIGNED_INT, texels.data(), texels.size());
}

void Texture::upload(int level, std::span<const std::int32_t> texels) {
    uploadBytes(level, glm::ivec3(0), size(level), GL_INT, texels.data(), texels.size());
}

void Texture::uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                           std::span<const float> texels) {
    uploadBytes(level, offset, extent, GL_FLOAT, texels.data(), texels.size());
}

void Texture::uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                           std::span<const std::uint8_t> texels) {
    uploadBytes(level, offset, extent, GL_UNSIGNED_BYTE, texels.data(), texels.size());
}

void Texture::uploadRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                           std::span<const std::uint16_t> texels) {
    const bool half = pixelFormat(mFormat).nativeType == GL_HALF_FLOAT;
    uploadBytes(level, offset, extent, half ? GL_HALF_FLOAT : GL_UNSIGNED_SHORT, texels.data(),
                texels.size());
}

void Texture::readBytes(int level, glm::ivec3 offset, glm::ivec3 extent, GLenum type, void* data,
                        std::size_t elements, std::size_t bytes) const {
    const PixelFormat pixel = pixelFormat(mFormat);
    CELADON_ASSERT(elements == count(extent) * static_cast<std::size_t>(pixel.channels));
    CELADON_ASSERT(glm::all(glm::lessThanEqual(offset + extent, size(level))));
    static_cast<void>(elements);
    resetPack();
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT); // for what shaders stored to images
    glGetTextureSubImage(id(), level, offset.x, offset.y, offset.z, extent.x, extent.y, extent.z,
                         pixel.clientFormat, type, static_cast<GLsizei>(bytes), data);
}

void Texture::readLevel(int level, std::span<float> texels) const {
    readRegion(level, glm::ivec3(0), size(level), texels);
}

void Texture::readRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                         std::span<float> texels) const {
    readBytes(level, offset, extent, GL_FLOAT, texels.data(), texels.size(), texels.size_bytes());
}

void Texture::readRegion(int level, glm::ivec3 offset, glm::ivec3 extent,
                         std::span<std::uint16_t> texels) const {
    CELADON_ASSERT(pixelFormat(mFormat).nativeType == GL_HALF_FLOAT);
    readBytes(level, offset, extent, GL_HALF_FLOAT, texels.data(), texels.size(),
              texels.size_bytes());
}

std::vector<float> Texture::readLevel(int level) const {
    return readRegion(level, glm::ivec3(0), size(level));
}

std::vector<float> Texture::readRegion(int level, glm::ivec3 offset, glm::ivec3 extent) const {
    std::vector<float> texels(count(extent) * static_cast<std::size_t>(channels()));
    readRegion(level, offset, extent, texels);
    return texels;
}

std::vector<std::uint32_t> Texture::readLevelUint(int level) const {
    std::vector<std::uint32_t> texels(texelCount(level) * static_cast<std::size_t>(channels()));
    readBytes(level, glm::ivec3(0), size(level), GL_UNSIGNED_INT, texels.data(), texels.size(),
              texels.size() * sizeof(std::uint32_t));
    return texels;
}

std::vector<std::int32_t> Texture::readLevelInt(int level) const {
    std::vector<std::int32_t> texels(texelCount(level) * static_cast<std::size_t>(channels()));
    readBytes(level, glm::ivec3(0), size(level), GL_INT, texels.data(), texels.size(),
              texels.size() * sizeof(std::int32_t));
    return texels;
}

void Texture::clearBytes(int level, GLenum type, const void* value) {
    CELADON_ASSERT(level >= 0 && level < mLevels);
    glClearTexImage(id(), level, pixelFormat(mFormat).clientFormat, type, value);
}

void Texture::clear(int level, glm::vec4 value) {
    clearBytes(level, GL_FLOAT, &value);
}

void Texture::clear(int level, glm::uvec4 value) {
    clearBytes(level, GL_UNSIGNED_INT, &value);
}

void Texture::clear(int level, glm::ivec4 value) {
    clearBytes(level, GL_INT, &value);
}

void Texture::generateMipmaps() {
    glGenerateTextureMipmap(id());
}

void Texture::bind(GLuint unit) const {
    glBindTextureUnit(unit, id());
}

void Texture::bindImage(GLuint unit, int level, GLenum access, int layer) const {
    CELADON_ASSERT(level >= 0 && level < mLevels);
    const GLboolean layered = layer < 0;
    glBindImageTexture(unit, id(), level, layered, std::max(layer, 0), access, mFormat);
}

} // namespace celadon::gl
