#pragma once

#include "renderer/gl/context.h"

#include <glad/gl.h>

#include <mutex>
#include <string>
#include <vector>

namespace celadon::gl {

/// What KHR_debug reports about one context. Private to context.cpp and debug.cpp.
struct Context::DebugLog {
    std::mutex mutex; ///< drivers may call back from their own threads
    std::vector<std::string> messages;
    std::vector<std::string> groups; ///< open debug groups, outermost first

    /// Turns debug output on for the current context; `this` must outlive it.
    void attach();
    void receive(GLenum source, GLenum type, GLenum severity, std::string_view text);

private:
    static void GLAD_API_PTR callback(GLenum source, GLenum type, GLuint id, GLenum severity,
                                      GLsizei length, const GLchar* text, const void* log);
};

} // namespace celadon::gl
