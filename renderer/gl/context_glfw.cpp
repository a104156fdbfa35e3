#include "renderer/gl/context_glfw.h"

#include "renderer/gl/backends.h"
#include "subedit/errors.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace celadon::gl {

namespace {

std::string takeGlfwError() {
    const char* text = nullptr;
    return glfwGetError(&text) != GLFW_NO_ERROR && text != nullptr ? text : "no error given";
}

class WindowContext final : public Context {
public:
    explicit WindowContext(GLFWwindow* window)
        : Context(ContextKind::Glfw, "glfw"), mWindow(window) {
        start();
    }

    /// With a hidden window of its own.
    WindowContext() : Context(ContextKind::Glfw, "glfw"), mOwnsWindow(true) {
        initializeGlfw();
        glfwDefaultWindowHints();
        setGlfwContextHints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        mWindow = glfwCreateWindow(1, 1, "Celadon", nullptr, nullptr);
        if (mWindow == nullptr) {
            throw ContextError(description(), takeGlfwError());
        }
        start();
    }
    ~WindowContext() override { destroy(); }

private:
    void start() {
        try {
            initialize(glfwGetProcAddress);
        } catch (...) {
            destroy();
            throw;
        }
    }

    void destroy() noexcept {
        retire();
        if (mOwnsWindow) {
            glfwDestroyWindow(mWindow);
        }
    }

    void bind() override {
        glfwMakeContextCurrent(mWindow);
        if (glfwGetCurrentContext() != mWindow) {
            throw ContextError(description(), takeGlfwError());
        }
    }

    void unbind() noexcept override { glfwMakeContextCurrent(nullptr); }

    GLFWwindow* mWindow = nullptr;
    bool mOwnsWindow = false;
};

} // namespace

void initializeGlfw() {
    if (glfwInit() != GLFW_TRUE) { // does nothing when it is initialized
        throw ContextError("glfw", takeGlfwError());
    }
}

void setGlfwContextHints() {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, kGlMajor);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, kGlMinor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
}

std::unique_ptr<Context> createWindowContext(GLFWwindow* window) {
    return std::make_unique<WindowContext>(window);
}

std::vector<ContextCandidate> glfwCandidates() {
    return {{"glfw", ContextKind::Glfw, false, [] { return std::make_unique<WindowContext>(); }}};
}

} // namespace celadon::gl
