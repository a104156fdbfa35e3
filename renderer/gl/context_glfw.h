#pragma once

#include "renderer/gl/context.h"

#include <memory>

struct GLFWwindow;

/// What the editor needs of GLFW beyond a hidden context: its own window as a Context.
namespace celadon::gl {

/// Initializes GLFW unless it is. Main thread only, as GLFW demands. There is no counterpart: to
/// terminate GLFW unloads libGL, which leaves its functions dangling, and Mesa's GLX does not come
/// up a second time ("X Error: BadAccess").
/// @throws ContextError with GLFW's reason (no display, for example)
void initializeGlfw();

/// Window hints for an OpenGL 4.5 core debug context; the caller adds its own before or after.
void setGlfwContextHints();

/// A Context on a window of the caller, who keeps it open until after the Context is gone.
/// @throws ContextError
[[nodiscard]] std::unique_ptr<Context> createWindowContext(GLFWwindow* window);

} // namespace celadon::gl
