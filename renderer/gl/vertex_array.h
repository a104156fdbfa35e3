#pragma once

#include "renderer/gl/buffer.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/handle.h"

#include <glad/gl.h>

#include <cstddef>
#include <string_view>

namespace celadon::gl {

/// How the shader sees the components of an attribute.
enum class AttributeKind {
    Float,      ///< as floats, unscaled
    Normalized, ///< integers mapped to [0, 1] or [-1, 1]
    Integer,    ///< as int or uint
};

/// One attribute within the elements of a buffer.
struct VertexAttribute {
    GLuint location = 0; ///< layout(location = …) in the vertex shader
    GLint components = 0;
    GLenum type = GL_FLOAT;
    std::size_t offsetBytes = 0; ///< within the element
    AttributeKind kind = AttributeKind::Float;
};

/// Which buffers the vertex shader reads. Without attributes it serves shaders that make vertices
/// from gl_VertexID.
class VertexArray {
public:
    VertexArray() = default;
    explicit VertexArray(std::string_view label) : mHandle(createVertexArray()) {
        labelObject(GL_VERTEX_ARRAY, id(), label);
    }

    /// Puts a buffer, which outlives its use, at a binding point; attributes may then refer to it.
    /// @param divisor 0: an element per vertex; n: one per n instances
    void setBuffer(GLuint binding, const Buffer& buffer, std::size_t strideBytes,
                   std::size_t offsetBytes = 0, GLuint divisor = 0) {
        glVertexArrayVertexBuffer(id(), binding, buffer.id(), static_cast<GLintptr>(offsetBytes),
                                  static_cast<GLsizei>(strideBytes));
        glVertexArrayBindingDivisor(id(), binding, divisor);
    }

    void setAttribute(GLuint binding, const VertexAttribute& attribute) {
        const auto offset = static_cast<GLuint>(attribute.offsetBytes);
        glEnableVertexArrayAttrib(id(), attribute.location);
        glVertexArrayAttribBinding(id(), attribute.location, binding);
        if (attribute.kind == AttributeKind::Integer) {
            glVertexArrayAttribIFormat(id(), attribute.location, attribute.components,
                                       attribute.type, offset);
        } else {
            const GLboolean normalized =
                attribute.kind == AttributeKind::Normalized ? GL_TRUE : GL_FALSE;
            glVertexArrayAttribFormat(id(), attribute.location, attribute.components,
                                      attribute.type, normalized, offset);
        }
    }

    void setIndexBuffer(const Buffer& buffer) { glVertexArrayElementBuffer(id(), buffer.id()); }

    [[nodiscard]] GLuint id() const { return mHandle.id(); }
    explicit operator bool() const { return static_cast<bool>(mHandle); }
    void bind() const { glBindVertexArray(id()); }

private:
    struct Traits {
        static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
    };
    static GLuint createVertexArray() {
        GLuint id = 0;
        glCreateVertexArrays(1, &id);
        return id;
    }

    Handle<Traits> mHandle;
};

} // namespace celadon::gl
