#include "ui/editor.h"

#include "renderer/output/atomic_file.h"
#include "renderer/output/image_io.h"
#include "subedit/errors.h"
#include "ui/background_open.h"
#include "ui/layout.h"
#include "ui/picture_worker.h"
#include "ui/recorder.h"
#include "ui/replayer.h"
#include "ui/shortcuts.h"
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
    mActions.putOn = [this](const std::string& material) {
        mOpen.start({mSession.opened().model, material});
    };
    mActions.save = [this] {
        if (mSession.materialFile) {
            mSession.perform({"file.save", {{"file", mSession.materialFile->string()}}});
        }
    };
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
    mTools.hover({static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)},
                 io.WantCaptureMouse);
}

void Editor::handleKey(const InputEvent& event) {
    const Shortcut* const shortcut = findShortcut(event.button, event.modifiers);
    if (shortcut == nullptr) {
        return;
    }
    const auto look = [this](const char* name) {
        mSession.perform({"camera.view", {{"name", name}}});
    };
    const auto turn = [this](double azimuth, double elevation) {
        mSession.perform({"camera.orbit", {{"azimuth", azimuth}, {"elevation", elevation}}});
    };
    const auto resize = [this](double factor) {
        const double radius = static_cast<double>(mSession.paint.brush.radiusMm);
        mSession.perform({"brush.change", {{"radius", radius * factor}}});
    };
    constexpr double kTurn = 15.0;
    constexpr double kResize = 1.15;
    switch (shortcut->action) {
    case Action::Help:
        mLayout.helpShown = !mLayout.helpShown;
        break;
    case Action::Panels:
        mLayout.panelsShown = !mLayout.panelsShown;
        break;
    case Action::FullScreen:
        mWindow.toggleFullScreen();
        break;
    case Action::Quit:
        mActions.quit();
        break;
    case Action::Undo:
        mSession.perform({"edit.undo"});
        break;
    case Action::Redo:
        mSession.perform({"edit.redo"});
        break;
    case Action::Swap:
        mSession.perform({"profile.swap"});
        break;
    case Action::Pick:
        if (const auto hit = mTools.pick(mTools.cursor(), mViewport.rect());
            hit && hit->material >= 0) {
            mSession.perform(
                {"profile.pick", {{"material", hit->material}, {"uv", {hit->uv.x, hit->uv.y}}}});
        }
        break;
    case Action::Radius:
        mTools.beginAdjust(ViewportTools::Adjust::Radius);
        break;
    case Action::Strength:
        mTools.beginAdjust(ViewportTools::Adjust::Strength);
        break;
    case Action::Smaller:
        resize(1.0 / kResize);
        break;
    case Action::Larger:
        resize(kResize);
        break;
    case Action::Frame:
        mSession.perform({"camera.frame", {{"aspect", mSession.aspect}}});
        break;
    case Action::Front:
        look("front");
        break;
    case Action::Right:
        look("right");
        break;
    case Action::Top:
        look("top");
        break;
    case Action::Back:
        look("back");
        break;
    case Action::Left:
        look("left");
        break;
    case Action::Bottom:
        look("bottom");
        break;
    case Action::Initial:
        look("initial");
        break;
    case Action::Projection:
        mSession.perform({"camera.projection",
                          {{"orthographic", !mSession.camera.orthographicHeight.has_value()}}});
        break;
    case Action::TurnLeft:
        turn(kTurn, 0.0);
        break;
    case Action::TurnRight:
        turn(-kTurn, 0.0);
        break;
    case Action::TurnUp:
        turn(0.0, kTurn);
        break;
    case Action::TurnDown:
        turn(0.0, -kTurn);
        break;
    case Action::Cancel:
        mLayout.helpShown = false;
        mTools.cancel();
        break;
    case Action::Save:
        mActions.save();
        break;
    case Action::SaveAs:
    case Action::Open:
    case Action::Select:
    case Action::Paint:
    case Action::Play:
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
