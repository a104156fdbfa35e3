#pragma once

#include "renderer/gl/context.h"
#include "ui/input_event.h"
#include "ui/pen_input.h"
#include "ui/preferences.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

/// A GLFW window with Dear ImGui on it, and what hands do to it, in order. Main thread.
namespace celadon::ui {

class Window {
public:
    /// @throws ContextError: no display, no OpenGL 4.5
    Window(const std::string& title, glm::ivec2 size, double scale);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    [[nodiscard]] GLFWwindow* handle() const { return mWindow; }
    /// A hidden window with a context for another thread; lives as long as this one.
    [[nodiscard]] GLFWwindow* workerWindow() const { return mWorkerWindow; }
    /// Another one, for work in the background.
    [[nodiscard]] GLFWwindow* jobsWindow() const { return mJobsWindow; }
    [[nodiscard]] gl::Context& context() { return *mContext; }
    /// Pixels of the frame buffer; zero while the window is minimized.
    [[nodiscard]] glm::ivec2 sizePx() const;
    /// Screen pixels per unit of layout.
    [[nodiscard]] float scale() const { return mScale; }
    /// @param scale 0: what the display says
    void setScale(float scale);
    void setTheme(Theme theme);

    /// Sleeps until something happens, or for so long. @param seconds 0: looks only; < 0: for ever
    void waitEvents(double seconds);
    /// From any thread.
    static void wake();
    [[nodiscard]] bool hadEvents() const { return mHadEvents || !mKeys.empty(); }
    void clearHadEvents() { mHadEvents = false; }
    [[nodiscard]] std::vector<InputEvent> takeInput();
    /// A pen that tells its pressure is connected.
    [[nodiscard]] bool hasPen() const { return mPen->hasPen(); }
    [[nodiscard]] std::vector<std::filesystem::path> takeDroppedFiles();

    /// @throws ContextError when the driver has lost the context (a reset)
    void beginFrame();
    /// Draws what ImGui was told; the back buffer can be read until present().
    void endFrame();
    void present();
    /// The back buffer between endFrame() and present(): RGB, rows from the top.
    [[nodiscard]] std::vector<unsigned char> readBackBuffer() const;

    [[nodiscard]] bool wantsClose() const;
    void cancelClose();
    void setTitle(const std::string& title);
    void toggleFullScreen();

private:
    struct KeyEvent {
        int key = 0;
        int scancode = 0;
        int action = 0;
        int modifiers = 0;
    };
    void installCallbacks();
    void pushKey(KeyChord chord, bool isRepeated);
    void passKeys();

    GLFWwindow* mWindow = nullptr;
    GLFWwindow* mWorkerWindow = nullptr;
    GLFWwindow* mJobsWindow = nullptr;
    std::unique_ptr<gl::Context> mContext;
    float mScale = 1.0f;
    Theme mTheme = Theme::Dark;
    bool mFontsStale = true;
    bool mHadEvents = true;
    bool mIsRepeating = false; ///< the key whose character comes next
    std::string mTitle;
    /// As the events in hand have it; GLFW's own answer is where it is by now, which is further on.
    glm::dvec2 mCursorPx{0.0};
    std::vector<InputEvent> mInput;
    std::unique_ptr<PenInput> mPen;
    std::vector<std::filesystem::path> mDropped;
    std::deque<KeyEvent> mKeys; ///< not yet passed to ImGui
    glm::ivec4 mWindowed{0};    ///< place and size before full screen
};

} // namespace celadon::ui
