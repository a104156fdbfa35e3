#include "renderer/gl/buffer.h"

#include "renderer/gl/debug.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace celadon::gl {

namespace {

/// GL refuses a storage of size 0 and ranges of size 0. Indirect commands and std430 blocks with a
/// few header words fit, so that an empty list needs no special case.
constexpr std::size_t kMinBytes = 16;

GLbitfield storageFlags(BufferUse use) {
    switch (use) {
    case BufferUse::Device:
        return 0;
    case BufferUse::Update:
        return GL_DYNAMIC_STORAGE_BIT;
    case BufferUse::Upload:
        return GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    case BufferUse::Readback:
        return GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT |
               GL_CLIENT_STORAGE_BIT;
    }
    return 0;
}

GLuint createBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return id;
}

} // namespace

Buffer::Buffer(std::string_view label, std::size_t bytes, BufferUse use)
    : mHandle(createBuffer()), mSize(bytes) {
    allocate(label, nullptr, use);
}

Buffer::Buffer(std::string_view label, std::span<const std::byte> content, BufferUse use)
    : mHandle(createBuffer()), mSize(content.size()) {
    allocate(label, content.size() >= kMinBytes ? content.data() : nullptr, use);
    if (!content.empty() && content.size() < kMinBytes) {
        // The storage is larger than the content, which hence comes by a copy.
        const Buffer small(label, kMinBytes, BufferUse::Update);
        glNamedBufferSubData(small.id(), 0, static_cast<GLsizeiptr>(content.size()),
                             content.data());
        glCopyNamedBufferSubData(small.id(), id(), 0, 0, static_cast<GLsizeiptr>(content.size()));
    }
}

void Buffer::allocate(std::string_view label, const void* content, BufferUse use) {
    labelObject(GL_BUFFER, id(), label);
    const std::size_t bytes = std::max(mSize, kMinBytes);
    glNamedBufferStorage(id(), static_cast<GLsizeiptr>(bytes), content, storageFlags(use));
    GLint64 allocated = 0;
    glGetNamedBufferParameteri64v(id(), GL_BUFFER_SIZE, &allocated);
    if (static_cast<std::size_t>(allocated) != bytes) {
        throw ContextError(
            fmt::format("GL buffer '{}'", label),
            fmt::format("no memory for {:.1f} MB", static_cast<double>(bytes) / 1e6));
    }
    if (use == BufferUse::Upload || use == BufferUse::Readback) {
        mMapped = static_cast<std::byte*>(
            glMapNamedBufferRange(id(), 0, static_cast<GLsizeiptr>(bytes),
                                  storageFlags(use) & ~GLbitfield{GL_CLIENT_STORAGE_BIT}));
        if (mMapped == nullptr) {
            throw ContextError(fmt::format("GL buffer '{}'", label), "it cannot be mapped");
        }
    }
}

void Buffer::write(std::size_t offsetBytes, std::span<const std::byte> content) {
    CELADON_ASSERT(offsetBytes + content.size() <= mSize);
    if (!content.empty()) {
        glNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes),
                             static_cast<GLsizeiptr>(content.size()), content.data());
    }
}

void Buffer::read(std::size_t offsetBytes, std::span<std::byte> destination) const {
    CELADON_ASSERT(offsetBytes + destination.size() <= mSize);
    if (destination.empty()) {
        return;
    }
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // for what shaders wrote
    glGetNamedBufferSubData(id(), static_cast<GLintptr>(offsetBytes),
                            static_cast<GLsizeiptr>(destination.size()), destination.data());
}

void Buffer::clear(std::size_t offsetBytes, std::size_t bytes) {
    CELADON_ASSERT(offsetBytes + bytes <= mSize && offsetBytes % 4 == 0 && bytes % 4 == 0);
    if (bytes > 0) {
        glClearNamedBufferSubData(id(), GL_R32UI, static_cast<GLintptr>(offsetBytes),
                                  static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER, GL_UNSIGNED_INT,
                                  nullptr);
    }
}

void Buffer::fill(GLuint word) {
    const std::size_t bytes = std::max(mSize, kMinBytes) / 4 * 4;
    glClearNamedBufferSubData(id(), GL_R32UI, 0, static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &word);
}

void Buffer::bindRange(GLenum target, GLuint binding, std::size_t offsetBytes,
                       std::size_t bytes) const {
    CELADON_ASSERT(offsetBytes + bytes <= std::max(mSize, kMinBytes) && bytes > 0);
    glBindBufferRange(target, binding, id(), static_cast<GLintptr>(offsetBytes),
                      static_cast<GLsizeiptr>(bytes));
}

void Buffer::bindStorage(GLuint binding) const {
    // A range rather than the base: the length of an unsized array is then that of the content.
    bindRange(GL_SHADER_STORAGE_BUFFER, binding, 0, mSize > 0 ? mSize : kMinBytes);
}

void Buffer::bindStorage(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const {
    bindRange(GL_SHADER_STORAGE_BUFFER, binding, offsetBytes, bytes);
}

void Buffer::bindUniform(GLuint binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, id());
}

void Buffer::bindUniform(GLuint binding, std::size_t offsetBytes, std::size_t bytes) const {
    bindRange(GL_UNIFORM_BUFFER, binding, offsetBytes, bytes);
}

void Buffer::bind(GLenum target) const {
    glBindBuffer(target, id());
}

} // namespace celadon::gl
