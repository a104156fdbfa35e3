#include "ui/editor.h"

#include "renderer/output/atomic_file.h"
#include "renderer/output/image_io.h"
#include "subedit/errors.h"
#include "ui/background_open.h"
#include "ui/journal.h"
#include "ui/layout.h"
#include "ui/panels/deform_panel.h"
#include "ui/panels/file_dialog.h"
#include "ui/panels/question.h"
#include "ui/picture_worker.h"
#include "ui/preferences.h"
#include "ui/recorder.h"
#include "ui/replayer.h"
#include "ui/shortcuts.h"
#include "ui/user_folders.h"
#include "ui/viewport.h"
#include "ui/viewport_tools.h"
#include "ui/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace celadon::ui {

namespace {

/// ImGui settles within so many frames after an event (hover, layout, popups).
constexpr int kSettlingFrames = 3;

/// @param rgb rows from the top
void writePicture(const std::filesystem::path& file, const std::vector<unsigned char>& rgb,
                  glm::ivec2 size) {
    FloatImage image;
    image.width = size.x;
    image.height = size.y;
    image.channels = {"R", "G", "B"};
    image.pixels.reserve(rgb.size());
    for (const unsigned char value : rgb) {
        image.pixels.push_back(static_cast<float>(value) / 255.0f);
    }
    writeDisplayImage(file, image);
}

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
    void drawWindows();
    void askBeforeLosing(const std::function<void()>& act);
    void chooseFile(FileDialog::Kind kind, const std::string& title,
                    std::vector<std::string> suffixes, const std::string& name,
                    std::function<void(const std::filesystem::path&)> done);
    void offerRecovery();
    void worldOpened();
    void watchFiles();
    void advancePlay();
    void setActions();
    void addWindowCommands();
    void savePreferences();
    void takeScreenshot(const std::filesystem::path& file);
    void writeState();
    [[nodiscard]] double secondsToSleep() const;
    [[nodiscard]] bool isQuiet() const;
    [[nodiscard]] bool isScripted() const;

    EditorOptions mOptions;
    Preferences mPreferences;
    Session mSession;
    Window mWindow;
    PictureWorker mWorker;
    Viewport mViewport;
    ViewportTools mTools;
    BackgroundOpen mOpen;
    LayoutState mLayout;
    LayoutActions mActions;
    FileDialog mFiles;
    Question mQuestion;
    Journal mJournal;
    std::optional<Recovery> mRecovery; ///< to be replayed once its model is open
    std::filesystem::path mLastFolder;
    std::optional<Recorder> mRecorder;
    std::optional<Replayer> mReplayer;
    std::optional<std::filesystem::path> mLastScreenshot; ///< --screenshot, still to be taken
    bool mIsPlaced = false;
    std::uint64_t mSeenWorld = 0;
    OpenRequest mWatched; ///< files whose times these are
    std::vector<std::filesystem::file_time_type> mWatchedTimes;
    std::chrono::steady_clock::time_point mPlayedUntil = std::chrono::steady_clock::now();
    bool mShouldClose = false;
    int mFramesToDraw = kSettlingFrames;
    std::string mWrittenState;
};

Editor::Editor(const EditorOptions& options)
    : mOptions(options),
      mPreferences(readPreferences(preferencesFile())),
      mSession(options.services),
      mWindow("Celadon", options.windowSize,
              options.scale > 0.0 ? options.scale : mPreferences.uiScale),
      mWorker(mWindow.workerWindow(), [] { Window::wake(); }),
      mViewport(mWorker, mPreferences.frameBudgetMs),
      mTools(mSession),
      mOpen(mSession),
      mJournal(stateFolder()),
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
    mSession.dispatcher().observe([this](const Command& command) {
        if (mPreferences.autosave && !isScripted()) {
            if (const auto problem = mJournal.add(command)) {
                mSession.notify(Notice::Kind::Warning, *problem);
            }
        }
    });
    setActions();
    addWindowCommands();
}

/// What concerns the window only, so that replays can show every panel.
void Editor::addWindowCommands() {
    Dispatcher& commands = mSession.dispatcher();
    commands.add(
        "window.tab", "Shows a tab of the side bar: brush, profile, material, light, deform, view",
        [this](const Arguments& a) { mLayout.tab = parseTab(a.text("name")); }, false);
    commands.add(
        "window.show", "Shows or hides panels, help, preferences",
        [this](const Arguments& a) {
            mLayout.panelsShown = a.flag("panels", mLayout.panelsShown);
            mLayout.helpShown = a.flag("help", mLayout.helpShown);
            mLayout.preferencesShown = a.flag("preferences", mLayout.preferencesShown);
        },
        false);
    commands.add(
        "window.scroll", "Scrolls the side bar, 0 top to 1 bottom",
        [this](const Arguments& a) { mLayout.scrollTo = a.numberWithin("to", 0.0, 1.0); }, false);
    commands.add(
        "window.dialog", "Opens a dialog: open, save",
        [this](const Arguments& a) {
            a.text("name") == "save" ? mActions.saveAs() : mActions.openModel();
        },
        false);
}

bool Editor::isScripted() const {
    return mOptions.replay || mOptions.exitAfterReplay;
}

void Editor::setActions() {
    const auto open = [this](const OpenRequest& request) {
        askBeforeLosing([this, request] { mOpen.start(request); });
    };
    mActions.open = [open](const std::string& model) { open({model, {}}); };
    mActions.putOn = [this, open](const std::string& material) {
        open({mSession.opened().model, material});
    };
    mActions.openModel = [this, open] {
        chooseFile(FileDialog::Kind::Open, "Open a model",
                   {".gltf", ".glb", ".obj", ".ply", ".off", ".stl"}, "", [open](const auto& file) {
                       open({file.string(), {}});
                   });
    };
    mActions.openMaterial = [this] {
        chooseFile(FileDialog::Kind::Open, "Open a material", {".subedit.exr"}, "",
                   [this](const auto& file) { mActions.putOn(file.string()); });
    };
    mActions.openEnvironment = [this] {
        chooseFile(FileDialog::Kind::Open, "Open an environment", {".hdr", ".exr"}, "",
                   [this](const auto& file) {
                       mSession.perform({"environment.open", {{"file", file.string()}}});
                   });
    };
    mActions.saveAs = [this] {
        if (mSession.activeDocument() == nullptr) {
            return;
        }
        const std::string name = mSession.materialFile
                                     ? mSession.materialFile->filename().string()
                                     : mSession.activeDocument()->material().name + ".subedit.exr";
        chooseFile(FileDialog::Kind::Save, "Save the material", {".subedit.exr"}, name,
                   [this](const auto& file) {
                       if (mSession.perform({"file.save", {{"file", file.string()}}})) {
                           addRecent(mPreferences.recentMaterials, file.string());
                           savePreferences();
                       }
                   });
    };
    mActions.save = [this] {
        if (mSession.materialFile) {
            mSession.perform({"file.save", {{"file", mSession.materialFile->string()}}});
        } else {
            mActions.saveAs();
        }
    };
    mActions.openDeformers = [this] {
        chooseFile(FileDialog::Kind::Open, "Open deformers", {".json"}, "",
                   [this](const auto& file) { openDeformers(mSession, file); });
    };
    mActions.saveDeformers = [this] {
        const std::string model = std::filesystem::path(mSession.opened().model).extension();
        std::vector<std::string> suffixes{".json"};
        if (model == ".glb" || model == ".gltf") {
            suffixes.push_back(model);
        }
        chooseFile(FileDialog::Kind::Save, "Save the deformers", suffixes, "deformers.json",
                   [this](const auto& file) {
                       if (mSession.perform({"deform.save", {{"file", file.string()}}})) {
                           mSession.notify(Notice::Kind::Info,
                                           fmt::format("Saved '{}'", file.string()));
                       }
                   });
    };
    mActions.savePicture = [this] {
        chooseFile(FileDialog::Kind::Save, "Save the picture", {".png"}, "celadon.png",
                   [this](const auto& file) {
                       try {
                           writePicture(file, mViewport.readPixels(), mViewport.shown().sizePx);
                           mSession.notify(Notice::Kind::Info,
                                           fmt::format("Saved '{}'", file.string()));
                       } catch (const Error& error) {
                           mSession.notify(Notice::Kind::Error, error.what());
                       }
                   });
    };
    mActions.toggleFullScreen = [this] { mWindow.toggleFullScreen(); };
    mActions.quit = [this] { askBeforeLosing([this] { mShouldClose = true; }); };
    mActions.preferencesChanged = [this] {
        if (mPreferences.uiScale > 0.0) {
            mWindow.setScale(static_cast<float>(mPreferences.uiScale));
        }
        savePreferences();
    };
}

void Editor::chooseFile(FileDialog::Kind kind, const std::string& title,
                        std::vector<std::string> suffixes, const std::string& name,
                        std::function<void(const std::filesystem::path&)> done) {
    std::filesystem::path folder = mLastFolder;
    if (folder.empty() && !mSession.opened().model.starts_with("builtin:")) {
        folder = std::filesystem::path(mSession.opened().model).parent_path();
    }
    mFiles.open(kind, title, std::move(suffixes), folder, name,
                [this, done = std::move(done)](const std::filesystem::path& file) {
                    mLastFolder = file.parent_path();
                    done(file);
                });
}

/// Unsaved changes are never lost without a word.
void Editor::askBeforeLosing(const std::function<void()>& act) {
    if (!mSession.isModified() || isScripted()) {
        act();
        return;
    }
    mQuestion.ask("Unsaved changes", "The material has changes that are not saved.",
                  {{"Save\xe2\x80\xa6", [this] { mActions.save(); }},
                   {"Do not save",
                    [this, act] {
                        mSession.markSaved();
                        act();
                    }},
                   {"Cancel", {}}});
}

void Editor::savePreferences() {
    try {
        writePreferences(mPreferences, preferencesFile());
    } catch (const Error& error) {
        mSession.notify(Notice::Kind::Warning, error.what());
    }
}

void Editor::offerRecovery() {
    const std::optional<Recovery> found = isScripted() ? std::nullopt : findRecovery(stateFolder());
    if (!found) {
        return;
    }
    mQuestion.ask(
        "Recovery",
        fmt::format("Celadon did not close properly. There are {} steps of painting on '{}' that "
                    "were perhaps not saved.",
                    found->commands.size(), found->opened.model),
        {{"Recover",
          [this, recovery = *found] {
              mRecovery = recovery;
              mOpen.start(recovery.opened);
          }},
         {"Discard",
          [file = found->file] {
              std::error_code ignored;
              std::filesystem::remove(file, ignored);
          }},
         {"Later", {}}});
}

void Editor::drawWindows() {
    drawLayout(mSession, mLayout, mPreferences, mActions, mViewport, mWindow.scale());
    mFiles.draw(mWindow.scale());
    mQuestion.draw(mWindow.scale());
}

void Editor::run() {
    mOpen.start(mOptions.open);
    offerRecovery();
    while (!mShouldClose) {
        step();
    }
    mJournal.finish();
}

void Editor::step() {
    mWindow.waitEvents(secondsToSleep());
    poll();
    if (mWindow.hadEvents()) {
        mWindow.clearHadEvents();
        mFramesToDraw = kSettlingFrames;
    }
    advancePlay();
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
        mWindow.cancelClose();
        mActions.quit();
        mFramesToDraw = kSettlingFrames;
    }
    const std::string name = std::filesystem::path(mSession.opened().model).filename().string();
    mWindow.setTitle(fmt::format("{}{} \xe2\x80\x94 Celadon", mSession.isModified() ? "*" : "",
                                 name.empty() ? "Celadon" : name));
}

/// Time goes on with the clock, and no further than pictures come: none is skipped for one that
/// would never be shown.
void Editor::advancePlay() {
    const auto now = std::chrono::steady_clock::now();
    if (!mSession.motion.isPlaying) {
        mPlayedUntil = now;
    } else if (!mViewport.isWaiting()) {
        mSession.advanceTime(std::chrono::duration<double>(now - mPlayedUntil).count());
        mPlayedUntil = now;
        mFramesToDraw = std::max(mFramesToDraw, 1);
    }
}

double Editor::secondsToSleep() const {
    const glm::ivec2 size = mWindow.sizePx();
    if (mFramesToDraw > 0 && size.x > 0 && size.y > 0) {
        return 0.0;
    }
    const bool hasScript =
        (mReplayer && !mReplayer->isDone()) || mLastScreenshot || mOptions.exitAfterReplay;
    const bool waitsForPicture = mReplayer && !mReplayer->isDone()
                                     ? mReplayer->dueScreenshot().has_value()
                                     : mLastScreenshot.has_value();
    if (hasScript && !mOpen.isRunning() && mSession.hasWorld() && (!waitsForPicture || isQuiet())) {
        return 0.0;
    }
    double seconds = mViewport.secondsToNextStep();
    if (mOpen.isRunning() && (seconds < 0.0 || seconds > 0.25)) {
        seconds = 0.25; // the status bar counts the seconds
    }
    constexpr double kWatchSeconds = 0.5;
    constexpr double kPlaySeconds = 1.0 / 60.0;
    if (mSession.motion.isPlaying && (seconds < 0.0 || seconds > kPlaySeconds)) {
        seconds = kPlaySeconds;
    }
    if (mOptions.watch && (seconds < 0.0 || seconds > kWatchSeconds)) {
        seconds = kWatchSeconds;
    }
    return seconds;
}

/// --watch: files that changed on disk are read again, unless the material was painted on.
void Editor::watchFiles() {
    if (!mOptions.watch || mOpen.isRunning() || !mSession.hasWorld()) {
        return;
    }
    const OpenRequest& opened = mSession.opened();
    std::vector<std::filesystem::file_time_type> times;
    for (const std::string& name : {opened.model, opened.material}) {
        std::error_code failed;
        const auto time = std::filesystem::last_write_time(name, failed);
        times.push_back(failed ? std::filesystem::file_time_type::min() : time);
    }
    const bool isSame = opened.model == mWatched.model && opened.material == mWatched.material;
    if (isSame && times != mWatchedTimes) {
        if (mSession.isModified()) {
            mSession.notify(Notice::Kind::Warning,
                            "A file changed on disk; it is not read again, since the material has "
                            "changes that are not saved");
        } else {
            mOpen.start(opened);
        }
        mFramesToDraw = kSettlingFrames;
    }
    mWatched = opened;
    mWatchedTimes = times;
}

void Editor::poll() {
    watchFiles();
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
        if (mSession.worldRevision() != mSeenWorld) {
            mSeenWorld = mSession.worldRevision();
            worldOpened();
        }
    }
    for (const std::filesystem::path& file : mWindow.takeDroppedFiles()) {
        mFramesToDraw = kSettlingFrames;
        const std::string name = file.filename().string();
        if (name.ends_with(".hdr") || (name.ends_with(".exr") && !name.ends_with(".subedit.exr"))) {
            mSession.perform({"environment.open", {{"file", file.string()}}});
        } else if (name.ends_with(".subedit.exr")) {
            mActions.putOn(file.string());
        } else {
            mActions.open(file.string());
        }
    }
}

void Editor::worldOpened() {
    const OpenRequest& opened = mSession.opened();
    if (!isScripted()) {
        addRecent(mPreferences.recentModels, opened.model);
        if (opened.material.ends_with(".subedit.exr")) {
            addRecent(mPreferences.recentMaterials, opened.material);
        }
        savePreferences();
    }
    mJournal.begin(opened);
    if (mRecovery && mRecovery->opened.model == opened.model) {
        const Recovery recovery = *std::exchange(mRecovery, std::nullopt);
        std::size_t done = 0;
        for (const Command& command : recovery.commands) {
            done += mSession.perform(command) ? 1 : 0;
        }
        mSession.notify(Notice::Kind::Info,
                        fmt::format("Recovered {} of {} steps; they are not saved yet", done,
                                    recovery.commands.size()));
        std::error_code ignored;
        std::filesystem::remove(recovery.file, ignored);
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
    drawWindows();
    mWindow.endFrame();
    mWindow.present();
}

void Editor::handleInput() {
    const ImGuiIO& io = ImGui::GetIO();
    for (const InputEvent& event : mWindow.takeInput()) {
        if (event.kind == InputEvent::Kind::Key) {
            if (!io.WantTextInput && !mFiles.isOpen() && !mQuestion.isOpen()) {
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
    case Action::Paint:
        mSession.perform({"tool.choose", {{"name", "paint"}}});
        break;
    case Action::Select:
        mSession.perform({"tool.choose", {{"name", "select"}}});
        break;
    case Action::SelectAll:
        mSession.perform({"select.change", {{"what", "all"}}});
        break;
    case Action::SelectNone:
        mSession.perform({"select.change", {{"what", "none"}}});
        break;
    case Action::SelectInvert:
        mSession.perform({"select.change", {{"what", "invert"}}});
        break;
    case Action::Save:
        mActions.save();
        break;
    case Action::SaveAs:
        mActions.saveAs();
        break;
    case Action::Open:
        mActions.openModel();
        break;
    case Action::Play:
        togglePlay(mSession);
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
    drawWindows();
    mWindow.endFrame();
    const glm::ivec2 size = mWindow.sizePx();
    const std::vector<unsigned char> pixels = mWindow.readBackBuffer();
    mWindow.present();
    writePicture(file, pixels, size);
}

void Editor::writeState() {
    if (!mOptions.state) {
        return;
    }
    const nlohmann::json state{
        {"model", mSession.opened().model},
        {"open", mSession.hasWorld()},
        {"opening", mOpen.isRunning()},
        {"settled", isQuiet()},
        {"rung", mViewport.shownRung()},
        {"revision", mSession.pictureRevision()},
        {"viewport",
         {mViewport.rect().origin.x, mViewport.rect().origin.y, mViewport.rect().size.x,
          mViewport.rect().size.y}},
        {"replayed", mReplayer ? mReplayer->executed() : 0},
        {"pictures", mViewport.pictureCount()},
        {"pictureMs", std::round(mViewport.shown().timeMs)},
        {"modified", mSession.isModified()},
        {"asking", mQuestion.isOpen() || mFiles.isOpen()},
        {"undo", mSession.activeDocument() != nullptr && mSession.activeDocument()->canUndo()},
        {"strokes",
         mSession.activeDocument() != nullptr ? mSession.activeDocument()->commands().size() : 0},
        {"notices", mSession.notices.empty() ? "" : mSession.notices.back().text}};
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
