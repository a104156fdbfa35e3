// In place of renderer/gl/context_glfw.cpp in a program without windows.
#include "renderer/gl/backends.h"

namespace celadon::gl {

std::vector<ContextCandidate> glfwCandidates() {
    return {};
}

} // namespace celadon::gl
