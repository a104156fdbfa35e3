#pragma once

#include <glad/gl.h>

#include <string_view>

/// Names that appear in debug messages and in graphics debuggers.
namespace celadon::gl {

/// Names a GL object. @param identifier GL_BUFFER, GL_TEXTURE, GL_PROGRAM, …
void labelObject(GLenum identifier, GLuint name, std::string_view label);

/// A named group of commands, from construction to destruction. Messages that arrive inside carry
/// the names of the open groups.
class DebugGroup {
public:
    explicit DebugGroup(std::string_view name);
    ~DebugGroup();
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

} // namespace celadon::gl
