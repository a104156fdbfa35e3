#include "ui/window.h"

#include "renderer/gl/context_glfw.h"
#include "subedit/errors.h"
#include "ui/theme.h"

#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace celadon::ui {

namespace {

constexpr int kLeastSize = 320;

Window* windowOf(GLFWwindow* handle) {
    return static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

GLFWwindow* createGlfwWindow(const std::string& title, glm::ivec2 size, bool visible,
                             GLFWwindow* share) {
    glfwDefaultWindowHints();
    gl::setGlfwContextHints();
    glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET); // and be told of it
    glfwWindowHint(GLFW_DEPTH_BITS, 0); // the window shows pictures only
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    GLFWwindow* const window = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, share);
    if (window == nullptr) {
        const char* text = nullptr;
        glfwGetError(&text);
        throw ContextError("window", text != nullptr ? text : "GLFW gives no reason",
                           "'celadon render' needs no display");
    }
    return window;
}

/// Keys that are known by what they type, wherever a keyboard has it.
struct TypedKey {
    unsigned character;
    KeyChord chord;
};
constexpr TypedKey kTypedKeys[] = {{'?', {GLFW_KEY_SLASH, GLFW_MOD_SHIFT}},
                                   {'[', {GLFW_KEY_LEFT_BRACKET, 0}},
                                   {']', {GLFW_KEY_RIGHT_BRACKET, 0}}};

bool isTyped(KeyChord chord) {
    return std::ranges::any_of(kTypedKeys,
                               [&](const TypedKey& typed) { return typed.chord == chord; });
}

/// GLFW numbers keys by what stands on them on a US keyboard: the letter that stands on this one.
int labelledKey(int key, int scancode) {
    const bool isPrintable = key > GLFW_KEY_SPACE && key <= GLFW_KEY_GRAVE_ACCENT;
    const char* const name = isPrintable ? glfwGetKeyName(key, scancode) : nullptr;
    if (name == nullptr || name[0] == '\0' || name[1] != '\0') {
        return key;
    }
    if (name[0] >= 'a' && name[0] <= 'z') {
        return name[0] - 'a' + GLFW_KEY_A;
    }
    constexpr std::string_view kOthers = "',-./0123456789;=[\\]`";
    return kOthers.find(name[0]) != std::string_view::npos ? name[0] : key;
}

} // namespace

Window::Window(const std::string& title, glm::ivec2 size, double scale) : mTitle(title) {
    gl::Context::releaseCurrent();
    gl::initializeGlfw();
    mWindow = createGlfwWindow(title, size, true, nullptr);
    mWorkerWindow = createGlfwWindow("Celadon renderer", {1, 1}, false, nullptr);
    mJobsWindow = createGlfwWindow("Celadon jobs", {1, 1}, false, nullptr);
    glfwSetWindowSizeLimits(mWindow, kLeastSize, kLeastSize, GLFW_DONT_CARE, GLFW_DONT_CARE);
    mContext = gl::createWindowContext(mWindow);
    glfwSwapInterval(mContext->isSoftware() ? 0 : 1);
    setScale(static_cast<float>(scale));
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // the layout is fixed
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    installCallbacks();
    mPen = std::make_unique<PenInput>(mWindow);
    ImGui_ImplGlfw_InitForOpenGL(mWindow, false); // our callbacks call its own
    ImGui_ImplOpenGL3_Init("#version 450");
}

Window::~Window() {
    mContext->makeCurrent();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    mContext.reset();
    mPen.reset();
    glfwDestroyWindow(mJobsWindow);
    glfwDestroyWindow(mWorkerWindow);
    glfwDestroyWindow(mWindow);
}

void Window::installCallbacks() {
    glfwSetWindowUserPointer(mWindow, this);
    glfwGetCursorPos(mWindow, &mCursorPx.x, &mCursorPx.y);
    glfwSetCursorPosCallback(mWindow, [](GLFWwindow* handle, double x, double y) {
        Window& self = *windowOf(handle);
        self.mHadEvents = true;
        self.mCursorPx = {x, y};
        self.mInput.push_back({InputEvent::Kind::Move, self.mCursorPx});
    });
    glfwSetMouseButtonCallback(
        mWindow, [](GLFWwindow* handle, int button, int action, int modifiers) {
            Window& self = *windowOf(handle);
            self.mHadEvents = true;
            InputEvent event{action == GLFW_RELEASE ? InputEvent::Kind::Release
                                                    : InputEvent::Kind::Press};
            event.positionPx = self.mCursorPx;
            event.button = button;
            event.modifiers = modifiers;
            self.mInput.push_back(event);
            ImGui_ImplGlfw_MouseButtonCallback(handle, button, action, modifiers);
        });
    glfwSetScrollCallback(mWindow, [](GLFWwindow* handle, double x, double y) {
        ImGui_ImplGlfw_ScrollCallback(handle, x, y);
        Window& self = *windowOf(handle);
        self.mHadEvents = true;
        InputEvent event{InputEvent::Kind::Wheel};
        event.positionPx = self.mCursorPx;
        event.wheel = y;
        self.mInput.push_back(event);
    });
    glfwSetKeyCallback(mWindow, [](GLFWwindow* handle, int key, int scancode, int action,
                                   int modifiers) {
        Window& self = *windowOf(handle);
        self.mHadEvents = true;
        self.mKeys.push_back({key, scancode, action, modifiers});
        const KeyChord chord{labelledKey(key, scancode), modifiers};
        self.mIsRepeating = action == GLFW_REPEAT;
        // AltGr makes other characters, and is no Alt to GLFW on some systems.
        const bool isAltGr =
            glfwGetKey(handle, GLFW_KEY_RIGHT_ALT) == GLFW_PRESS && (modifiers & GLFW_MOD_ALT) == 0;
        if (action != GLFW_RELEASE && !isTyped(chord) && !isAltGr) {
            self.pushKey(chord, action == GLFW_REPEAT);
        }
    });
    glfwSetDropCallback(mWindow, [](GLFWwindow* handle, int count, const char** paths) {
        Window& self = *windowOf(handle);
        self.mHadEvents = true;
        self.mDropped.insert(self.mDropped.end(), paths, paths + count);
    });
    const auto redraw = [](GLFWwindow* handle) { windowOf(handle)->mHadEvents = true; };
    glfwSetWindowRefreshCallback(mWindow, redraw);
    glfwSetWindowCloseCallback(mWindow, redraw);
    glfwSetCharCallback(mWindow, [](GLFWwindow* handle, unsigned character) {
        windowOf(handle)->mHadEvents = true;
        for (const TypedKey& typed : kTypedKeys) {
            if (typed.character == character) {
                windowOf(handle)->pushKey(typed.chord, windowOf(handle)->mIsRepeating);
            }
        }
        ImGui_ImplGlfw_CharCallback(handle, character);
    });
    glfwSetWindowFocusCallback(mWindow, [](GLFWwindow* handle, int focused) {
        windowOf(handle)->mHadEvents = true;
        ImGui_ImplGlfw_WindowFocusCallback(handle, focused);
    });
    glfwSetCursorEnterCallback(mWindow, [](GLFWwindow* handle, int entered) {
        windowOf(handle)->mHadEvents = true;
        ImGui_ImplGlfw_CursorEnterCallback(handle, entered);
    });
    glfwSetFramebufferSizeCallback(
        mWindow, [](GLFWwindow* handle, int, int) { windowOf(handle)->mHadEvents = true; });
}

void Window::pushKey(KeyChord chord, bool isRepeated) {
    InputEvent event{InputEvent::Kind::Key};
    event.positionPx = mCursorPx;
    event.button = chord.key;
    event.modifiers = chord.modifiers;
    event.isRepeated = isRepeated;
    mInput.push_back(event);
}

glm::ivec2 Window::sizePx() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(mWindow, &size.x, &size.y);
    return size;
}

void Window::setScale(float scale) {
    if (scale <= 0.0f) {
        float x = 1.0f;
        float y = 1.0f;
        glfwGetWindowContentScale(mWindow, &x, &y);
        scale = std::max(x, y);
    }
    mScale = std::clamp(scale, 0.5f, 4.0f);
    mFontsStale = true;
    mHadEvents = true;
}

void Window::setTheme(Theme theme) {
    mFontsStale = mFontsStale || theme != mTheme;
    mTheme = theme;
    mHadEvents = true;
}

void Window::waitEvents(double seconds) {
    if (seconds < 0.0) {
        glfwWaitEvents();
    } else if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
}

void Window::wake() {
    glfwPostEmptyEvent();
}

std::vector<InputEvent> Window::takeInput() {
    mPen->tell(mInput);
    return std::exchange(mInput, {});
}

std::vector<std::filesystem::path> Window::takeDroppedFiles() {
    return std::exchange(mDropped, {});
}

/// ImGui 1.86 looks at the state of keys once a frame: a key that goes down and up between two
/// frames would be lost. So its release waits for the next frame.
void Window::passKeys() {
    std::vector<int> pressed;
    while (!mKeys.empty()) {
        const KeyEvent event = mKeys.front();
        if (std::find(pressed.begin(), pressed.end(), event.key) != pressed.end()) {
            break;
        }
        if (event.action == GLFW_PRESS) {
            pressed.push_back(event.key);
        }
        mKeys.pop_front();
        ImGui_ImplGlfw_KeyCallback(mWindow, event.key, event.scancode, event.action,
                                   event.modifiers);
    }
}

void Window::beginFrame() {
    mContext->makeCurrent();
    if (glGetGraphicsResetStatus() != GL_NO_ERROR) {
        throw ContextError("window", "the driver was reset, and the picture is lost",
                           "start again: what was painted is offered for recovery");
    }
    passKeys();
    if (mFontsStale) {
        loadFonts(mScale);
        applyTheme(mTheme, mScale);
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
        mFontsStale = false;
    }
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Window::endFrame() {
    ImGui::Render();
    const glm::ivec2 size = sizePx();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_RASTERIZER_DISCARD);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0.055f, 0.06f, 0.065f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::present() {
    glfwSwapBuffers(mWindow);
}

std::vector<unsigned char> Window::readBackBuffer() const {
    const glm::ivec2 size = sizePx();
    const auto row = static_cast<std::size_t>(size.x) * 3;
    std::vector<unsigned char> upward(row * static_cast<std::size_t>(size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
    std::vector<unsigned char> downward(upward.size());
    for (std::size_t y = 0; y < static_cast<std::size_t>(size.y); ++y) {
        std::copy_n(upward.data() + y * row, row,
                    downward.data() + (static_cast<std::size_t>(size.y) - 1 - y) * row);
    }
    return downward;
}

bool Window::wantsClose() const {
    return glfwWindowShouldClose(mWindow) == GLFW_TRUE;
}

void Window::cancelClose() {
    glfwSetWindowShouldClose(mWindow, GLFW_FALSE);
}

void Window::setTitle(const std::string& title) {
    if (title != mTitle) {
        mTitle = title;
        glfwSetWindowTitle(mWindow, title.c_str());
    }
}

void Window::toggleFullScreen() {
    if (glfwGetWindowMonitor(mWindow) != nullptr) {
        glfwSetWindowMonitor(mWindow, nullptr, mWindowed.x, mWindowed.y, mWindowed.z, mWindowed.w,
                             GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) {
        return;
    }
    glfwGetWindowPos(mWindow, &mWindowed.x, &mWindowed.y);
    glfwGetWindowSize(mWindow, &mWindowed.z, &mWindowed.w);
    glfwSetWindowMonitor(mWindow, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

} // namespace celadon::ui
