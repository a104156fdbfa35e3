#include "ui/editor.h"

#include "renderer/output/atomic_file.h"
#include "renderer/output/image_io.h"
#include "subedit/errors.h"
#include "ui/background_open.h"
#include "ui/layout.h"
#include "ui/picture_worker.h"
#include "ui/recorder.h"
#include "ui/replayer.h"
#include "ui/viewport.h"
#include "ui/viewport_tools.h"
#include "ui/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace celadon::ui {

namespace {

/// ImGui settles within so many frames after an event (hover, layout, popups).
constexpr int kSettlingFrames = 3;

class Editor {
public:
    explicit Editor(const EditorOptions& options);
    void run();

private:
    void loop();
    void step();
    void poll();
    void drawFrame();
    void handleInput();
    void handleKey(const InputEvent& event);
    void advanceReplay();
    void takeScreenshot(const std::filesystem::path& file);
    void writeState();
    [[nodiscard]] double secondsToSleep() const;
    [[nodiscard]] bool isQuiet() const;

    EditorOptions mOptions;
    Session mSession;
    Window mWindow;
    PictureWorker mWorker;
    Viewport mViewport;
    ViewportTools mTools;
    BackgroundOpen mOpen;
    LayoutState mLayout;
    LayoutActions mActions;
    std::optional<Recorder> mRecorder;
    std::optional<Replayer> mReplayer;
    std::optional<std::filesystem::path> mLastScreenshot; ///< --screenshot, still to be taken
    bool mIsPlaced = false;
    bool mShouldClose = false;
    int mFramesToDraw = kSettlingFrames;
    std::string mWrittenState;
};

Editor::Editor(const EditorOptions& options)
    : mOptions(options),
      mSession(options.services),
      mWindow("Celadon", options.windowSize, options.scale),
      mWorker(mWindow.workerWindow(), [] { Window::wake(); }),
      mViewport(mWorker),
      mTools(mSession),
      mOpen(mSession),
      mLastScreenshot(options.screenshot) {
    if (options.record) {
        mRecorder.emplace(*options.record);
        mSession.dispatcher().observe(
            [this](const Command& command) { mRecorder->write(command); });
    }
    if (options.replay || !options.screenshotsAt.empty()) {
        mReplayer.emplace(options.replay ? readCommands(*options.replay) : std::vector<Command>(),
                          options.screenshotsAt);
    }
    for (int i = 0; i < static_cast<int>(mViewport.ladder().rungs().size()); ++i) {
        if (mViewport.ladder().rungs()[static_cast<std::size_t>(i)].quality <= options.finest) {
            mViewport.setFinestRung(i);
        }
    }
    mActions.open = [this](const std::string& model) { mOpen.start({model, {}}); };
    mActions.toggleFullScreen = [this] { mWindow.toggleFullScreen(); };
    mActions.quit = [this] { mShouldClose = true; };
}

void Editor::run() {
    mOpen.start(mOptions.open);
    while (!mShouldClose) {
        step();
    }
}

void Editor::step() {
    mWindow.waitEvents(secondsToSleep());
    poll();
    if (mWindow.hadEvents()) {
        mWindow.clearHadEvents();
        mFramesToDraw = kSettlingFrames;
    }
    const glm::ivec2 size = mWindow.sizePx();
    if (mFramesToDraw > 0 && size.x > 0 && size.y > 0) {
        --mFramesToDraw;
        drawFrame();
    }
    if (mViewport.update(mSession)) {
        mFramesToDraw = std::max(mFramesToDraw, 1);
    }
    advanceReplay();
    writeState();
    if (mWindow.wantsClose()) {
        mShouldClose = true;
    }
}

double Editor::secondsToSleep() const {
    const glm::ivec2 size = mWindow.sizePx();
    if (mFramesToDraw > 0 && size.x > 0 && size.y > 0) {
        return 0.0;
    }
    const bool isScripted =
        (mReplayer && !mReplayer->isDone()) || mLastScreenshot || mOptions.exitAfterReplay;
    const bool waitsForPicture = mReplayer && !mReplayer->isDone()
                                     ? mReplayer->dueScreenshot().has_value()
                                     : mLastScreenshot.has_value();
    if (isScripted && !mOpen.isRunning() && mSession.hasWorld() &&
        (!waitsForPicture || isQuiet())) {
        return 0.0;
    }
    double seconds = mViewport.secondsToNextStep();
    if (mOpen.isRunning() && (seconds < 0.0 || seconds > 0.25)) {
        seconds = 0.25; // the status bar counts the seconds
    }
    return seconds;
}

void Editor::poll() {
    if (mOpen.isRunning()) {
        mLayout.activity =
            fmt::format("Opening {} \xe2\x80\xa6 {:.0f} s", mOpen.request().model, mOpen.seconds());
        mFramesToDraw = std::max(mFramesToDraw, 1);
    }
    if (mOpen.poll()) {
        mFramesToDraw = kSettlingFrames;
        if (!mOpen.isRunning()) {
            mLayout.activity.clear();
        }
        if (mSession.hasWorld() && !mIsPlaced && mOptions.place) {
            mOptions.place(mSession);
            mIsPlaced = true;
        }
    }
    for (const std::filesystem::path& file : mWindow.takeDroppedFiles()) {
        const std::string name = file.filename().string();
        if (name.ends_with(".hdr") || (name.ends_with(".exr") && !name.ends_with(".subedit.exr"))) {
            mSession.perform({"environment.open", {{"file", file.string()}}});
        } else if (name.ends_with(".subedit.exr")) {
            mOpen.start({mSession.opened().model, file.string()});
        } else {
            mOpen.start({file.string(), {}});
        }
    }
}

void Editor::drawFrame() {
    mWindow.beginFrame();
    const ViewportRect rect = viewportRect(mWindow.sizePx(), mLayout, mWindow.scale());
    mViewport.setRect(rect);
    mSession.aspect = rect.aspect();
    handleInput();
    ImDrawList& background = *ImGui::GetBackgroundDrawList();
    mViewport.draw(background);
    mTools.drawOverlay(background, rect, mWindow.scale());
    drawLayout(mSession, mLayout, mActions, mViewport, mWindow.scale());
    mWindow.endFrame();
    mWindow.present();
}

void Editor::handleInput() {
    const ImGuiIO& io = ImGui::GetIO();
    for (const InputEvent& event : mWindow.takeInput()) {
        if (event.kind == InputEvent::Kind::Key) {
            if (!io.WantTextInput) {
                handleKey(event);
            }
            continue;
        }
        mTools.handle(event, mViewport.rect(), io.WantCaptureMouse && !mTools.isDragging());
    }
}

void Editor::handleKey(const InputEvent& event) {
    const bool control = (event.modifiers & GLFW_MOD_CONTROL) != 0;
    switch (event.button) {
    case GLFW_KEY_H:
        mLayout.panelsShown = !mLayout.panelsShown;
        break;
    case GLFW_KEY_F11:
        mWindow.toggleFullScreen();
        break;
    case GLFW_KEY_Q:
        mShouldClose = mShouldClose || control;
        break;
    case GLFW_KEY_KP_1:
        mSession.perform({"camera.view", {{"name", control ? "back" : "front"}}});
        break;
    case GLFW_KEY_KP_3:
        mSession.perform({"camera.view", {{"name", control ? "left" : "right"}}});
        break;
    case GLFW_KEY_KP_7:
        mSession.perform({"camera.view", {{"name", control ? "bottom" : "top"}}});
        break;
    case GLFW_KEY_KP_0:
        mSession.perform({"camera.view", {{"name", "initial"}}});
        break;
    case GLFW_KEY_KP_5:
        mSession.perform({"camera.projection",
                          {{"orthographic", !mSession.camera.orthographicHeight.has_value()}}});
        break;
    case GLFW_KEY_HOME:
    case GLFW_KEY_KP_DECIMAL:
        mSession.perform({"camera.frame", {{"aspect", mSession.aspect}}});
        break;
    default:
        break;
    }
}

bool Editor::isQuiet() const {
    return !mOpen.isRunning() && mViewport.isSettled(mSession) && mFramesToDraw == 0;
}

void Editor::advanceReplay() {
    if (mOpen.isRunning() || !mSession.hasWorld()) {
        return;
    }
    if (mReplayer && !mReplayer->isDone()) {
        if (const auto file = mReplayer->dueScreenshot()) {
            if (isQuiet()) {
                takeScreenshot(*file);
                mReplayer->screenshotTaken();
            }
        } else if (const std::optional<Command> command = mReplayer->next()) {
            mSession.execute(*command);
            mFramesToDraw = kSettlingFrames;
        }
        return;
    }
    if (mLastScreenshot) {
        if (isQuiet()) {
            takeScreenshot(*mLastScreenshot);
            mLastScreenshot.reset();
        }
        return;
    }
    if (mOptions.exitAfterReplay) {
        mShouldClose = true;
    }
}

void Editor::takeScreenshot(const std::filesystem::path& file) {
    mWindow.beginFrame();
    handleInput();
    ImDrawList& background = *ImGui::GetBackgroundDrawList();
    mViewport.draw(background);
    mTools.drawOverlay(background, mViewport.rect(), mWindow.scale());
    drawLayout(mSession, mLayout, mActions, mViewport, mWindow.scale());
    mWindow.endFrame();
    const glm::ivec2 size = mWindow.sizePx();
    const std::vector<unsigned char> pixels = mWindow.readBackBuffer();
    mWindow.present();
    FloatImage image;
    image.width = size.x;
    image.height = size.y;
    image.channels = {"R", "G", "B"};
    image.pixels.reserve(pixels.size());
    for (const unsigned char value : pixels) {
        image.pixels.push_back(static_cast<float>(value) / 255.0f);
    }
    writeDisplayImage(file, image);
}

void Editor::writeState() {
    if (!mOptions.state) {
        return;
    }
    const nlohmann::json state{{"model", mSession.opened().model},
                               {"open", mSession.hasWorld()},
                               {"opening", mOpen.isRunning()},
                               {"settled", isQuiet()},
                               {"rung", mViewport.shownRung()},
                               {"revision", mSession.pictureRevision()},
                               {"viewport",
                                {mViewport.rect().origin.x, mViewport.rect().origin.y,
                                 mViewport.rect().size.x, mViewport.rect().size.y}},
                               {"replayed", mReplayer ? mReplayer->executed() : 0},
                               {"notices", mSession.notices.size()}};
    const std::string text = state.dump() + "\n";
    if (text != mWrittenState) {
        writeFileAtomically(*mOptions.state, text);
        mWrittenState = text;
    }
}

} // namespace

void runEditor(const EditorOptions& options) {
    Editor editor(options);
    editor.run();
}

} // namespace celadon::ui
