#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/debug.h"

/// The elements of a buffer as texels (samplerBuffer), which software drivers fetch several times
/// as fast as elements of storage blocks.
namespace celadon::gl {

class BufferTexture {
public:
    BufferTexture() = default;
    /// @param internalFormat GL_R32F, GL_R32UI …; @param buffer outlives this
    BufferTexture(std::string_view label, GLenum internalFormat, const Buffer& buffer)
        : mHandle(create()) {
        labelObject(GL_TEXTURE, mHandle.id(), label);
        glTextureBuffer(mHandle.id(), internalFormat, buffer.id());
    }

    void bind(GLuint unit) const { glBindTextureUnit(unit, mHandle.id()); }

    /// Of all formats, in texels.
    [[nodiscard]] static GLint64 greatestSize() {
        GLint64 size = 0;
        glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &size);
        return size;
    }

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteTextures(1, &id); }
    };
    static GLuint create() {
        GLuint id = 0;
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
        return id;
    }

    Handle<Traits> mHandle;
};

} // namespace celadon::gl
