#pragma once

#include "renderer/gl/context.h"

#include <memory>

struct GLFWwindow;

/// What the editor needs of GLFW beyond a hidden context: its own window as a Context.
namespace celadon::gl {

/// Keeps GLFW initialized. The library is initialized once for the process and terminated with the
/// last session, so that a hidden context and the editor's window do not end each other.
/// Main thread only, as GLFW demands.
class GlfwSession {
public:
    /// @throws ContextError with GLFW's reason (no display, for example)
    GlfwSession();
    ~GlfwSession();
    GlfwSession(const GlfwSession&) = delete;
    GlfwSession& operator=(const GlfwSession&) = delete;
};

/// Window hints for an OpenGL 4.5 core debug context; the caller adds its own before or after.
void setGlfwContextHints();

/// A Context on a window of the caller, who keeps it open until after the Context is gone.
/// @throws ContextError
[[nodiscard]] std::unique_ptr<Context> createWindowContext(GLFWwindow* window);

} // namespace celadon::gl
