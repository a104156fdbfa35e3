#include "ui/editor.h"

#include "subedit/errors.h"
#include "ui/background_jobs.h"
#include "ui/background_open.h"
#include "ui/file_actions.h"
#include "ui/file_watch.h"
#include "ui/input_router.h"
#include "ui/key_actions.h"
#include "ui/layout.h"
#include "ui/panels/long_edit.h"
#include "ui/picture_file.h"
#include "ui/picture_worker.h"
#include "ui/playback.h"
#include "ui/preferences_commands.h"
#include "ui/recovery_run.h"
#include "ui/script.h"
#include "ui/state_report.h"
#include "ui/thumbnails.h"
#include "ui/truth_view.h"
#include "ui/user_folders.h"
#include "ui/viewport.h"
#include "ui/viewport_tools.h"
#include "ui/window.h"
#include "ui/window_commands.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace celadon::ui {

namespace {

/// ImGui settles within so many frames after an event (hover, layout, popups).
constexpr int kSettlingFrames = 3;
constexpr double kWatchSeconds = 0.5;
/// Of the interface where the driver is software: the rest of the processor makes the picture.
constexpr std::chrono::milliseconds kSoftwareFrame{25};

class Editor {
public:
    explicit Editor(const EditorOptions& options);
    void run();

private:
    void step();
    void poll();
    void pollOpening();
    void pollSaving();
    void worldOpened();
    void showActivity();
    [[nodiscard]] std::string activity() const; ///< what is being waited for
    void cancelJobs();
    void offerRecovery();
    void act(Action action) {
        performAction(action,
                      {mSession, mTools, mViewport.rect(), mLayout, mActions, mPreferences.keys});
    }
    void composeFrame();
    void drawFrame();
    void drawContents();
    /// While an edit lasts: the window goes on. @throws GivenUp
    void showProgress(const std::string& title, float done);
    void advanceScript();
    void setActions();
    void applyPreferences();
    void keepJournal();
    void takeScreenshot(const std::filesystem::path& file);
    [[nodiscard]] bool mustDraw() const;
    [[nodiscard]] double secondsToFrame() const; ///< until the next one may be drawn
    [[nodiscard]] double secondsToSleep() const;
    [[nodiscard]] Script::Progress progress() const;

    EditorOptions mOptions;
    Preferences mPreferences;
    Session mSession;
    Script mScript;
    Window mWindow;
    PictureWorker mWorker;
    Viewport mViewport;
    ViewportTools mTools;
    BackgroundOpen mOpen;
    Journal mJournal;
    RecoveryRun mRecovery;
    FileActions mFiles;
    LayoutState mLayout;
    LayoutActions mActions;
    FileWatch mWatch;
    bool mIsPlaced = false;
    std::uint64_t mSeenWorld = 0;
    OpenRequest mSeenScene; ///< the last of which there was a picture
    bool mShouldClose = false;
    int mFramesToDraw = kSettlingFrames;
    bool mIsDrawing = false; ///< within a frame
    LongEdit mLongEdit;
    InputRouter mInput;
    Playback mPlayback;
    std::chrono::steady_clock::time_point mNextFrame;
    BackgroundJobs mJobs; ///< after all that its results touch
    Thumbnails mThumbnails;
    TruthView mTruth;
};

Editor::Editor(const EditorOptions& options)
    : mOptions(options),
      mPreferences(readPreferences(preferencesFile())),
      mSession(options.services),
      mScript(mOptions, mSession),
      mWindow("Celadon", options.windowSize,
              options.scale > 0.0 ? options.scale : mPreferences.uiScale),
      mWorker(mWindow.workerWindow(), [] { Window::wake(); }),
      mViewport(mWorker, mPreferences.frameBudgetMs),
      mTools(mSession),
      mOpen(mSession),
      mJournal(stateFolder()),
      mRecovery(mSession, mJournal),
      mFiles(mSession, mOpen, mPreferences, mScript.isUnattended()),
      mSeenScene(options.greeting),
      mInput({mSession, mTools, mViewport, mLayout, mPreferences, mRecovery, mFiles, mLongEdit,
              [this](Action action) { act(action); }}),
      mPlayback(mSession, mViewport, mLayout),
      mJobs(mWindow.jobsWindow(), [] { Window::wake(); }),
      mThumbnails(mJobs, cacheFolder() / "thumbnails"),
      mTruth(mJobs) {
    for (int i = 0; i < static_cast<int>(mViewport.ladder().rungs().size()); ++i) {
        if (mViewport.ladder().rungs()[static_cast<std::size_t>(i)].quality <= options.finest) {
            mViewport.setFinestRung(i);
        }
    }
    mViewport.rehearse(!mScript.isUnattended());
    if (!mScript.isUnattended()) {
        mSession.onProgress = [this](const std::string& title, float done) {
            showProgress(title, done);
        };
    }
    keepJournal();
    setActions();
    addWindowCommands(mSession, {mLayout, mFiles, mTools, mViewport, mJobs,
                                 [this](Action action) { act(action); }});
    addPreferencesCommands(mSession.dispatcher(), mPreferences, [this] {
        applyPreferences();
        mWindow.setScale(
            static_cast<float>(mPreferences.uiScale > 0.0 ? mPreferences.uiScale : mOptions.scale));
        mFiles.savePreferences();
    });
}

void Editor::keepJournal() {
    mSession.dispatcher().observe([this](const Command& command) {
        if (command.name == "scene.size") { // the same scene: its journal goes on
            mSeenWorld = mSession.worldRevision();
            mSeenScene = mSession.opened();
            if (!mScript.isUnattended()) {
                mTools.prepare();
            }
        }
        // Steps that are recovered stay in the journal that they come from until all are done.
        if (mPreferences.autosave && !mScript.isUnattended() && !mRecovery.isRunning()) {
            if (const auto problem = mJournal.add(command)) {
                mSession.notify(Notice::Kind::Warning, *problem);
            }
        }
    });
    mSession.beforeResizing = [this] { mFiles.finishSaving(); };
    mSession.beforeWriting = [this](const std::filesystem::path& file) {
        if (const auto problem = mJournal.keep(file)) {
            mSession.notify(Notice::Kind::Warning, *problem);
        }
    };
}

void Editor::setActions() {
    mActions.open = [this](const std::string& model) { mFiles.open({model, {}}); };
    mActions.putOn = [this](const std::string& material) { mFiles.putOn(material); };
    mActions.openModel = [this] { mFiles.openModel(); };
    mActions.openMaterial = [this] { mFiles.openMaterial(); };
    mActions.openEnvironment = [this] { mFiles.openEnvironment(); };
    mActions.openStamp = [this] { mFiles.openStamp(); };
    mActions.openDeformers = [this] { mFiles.openDeformers(); };
    mActions.saveDeformers = [this] { mFiles.saveDeformers(); };
    mActions.save = [this] { mFiles.save(); };
    mActions.saveAs = [this] { mFiles.saveAs(); };
    mActions.saveAsNew = [this](const std::string& name) { mFiles.saveAsNew(name); };
    mActions.exportGltf = [this] { mFiles.exportGltf(); };
    mActions.savePicture = [this] {
        mFiles.chooseOutput("Save the picture", pictureSuffixes(), "celadon.png",
                            [this](const auto& file) {
                                mSession.perform({"export.picture", {{"file", file.string()}}});
                            });
    };
    mActions.saveTurntable = [this](int frames) {
        mFiles.chooseOutput("Save a turntable", pictureSuffixes(), "turntable.png",
                            [this, frames](const auto& file) {
                                mSession.perform({"export.turntable",
                                                  {{"file", file.string()}, {"frames", frames}}});
                            });
    };
    mActions.cancelJobs = [this] { cancelJobs(); };
    mActions.toggleFullScreen = [this] { mWindow.toggleFullScreen(); };
    mActions.togglePlay = [this] { mPlayback.toggle(); };
    mActions.toggleTurntable = [this] { mPlayback.toggleTurntable(); };
    mActions.quit = [this] {
        if (mRecovery.isRunning()) {
            mSession.notify(Notice::Kind::Info, "A recovery is under way, and soon done");
            return;
        }
        mFiles.guard([this] { mShouldClose = true; });
    };
    applyPreferences();
}

void Editor::applyPreferences() {
    mWindow.setTheme(mPreferences.theme);
    mSession.setHistoryBytes(static_cast<std::size_t>(mPreferences.undoMegabytes * 1048576.0));
}

void Editor::offerRecovery() {
    const std::optional<Recovery> found =
        mScript.isUnattended() ? std::nullopt : findRecovery(stateFolder());
    if (!found) {
        return;
    }
    const std::size_t steps = found->steps();
    mFiles.ask(
        "Recovery",
        fmt::format("Celadon did not close properly{}. {} step{} on '{}' may not have been saved.",
                    found->reason.empty() ? "" : " (" + found->reason + ")", steps,
                    steps == 1 ? "" : "s", found->opened.model),
        {{"Recover",
          [this, recovery = *found] {
              mRecovery.await(recovery);
              mOpen.start(recovery.opened);
          }},
         {"Discard", [recovery = *found] { discard(recovery); }},
         {"Later", {}}});
}

void Editor::run() {
    mOpen.start(mOptions.open);
    offerRecovery();
    try {
        while (!mShouldClose) {
            step();
        }
    } catch (const ContextError& error) { // a window that vanishes cannot say why
        mJournal.explain(error.what());
        throw;
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
    if (mustDraw() && secondsToFrame() <= 0.0) {
        --mFramesToDraw;
        drawFrame();
    }
    mSession.performWaiting();
    if (mLongEdit.isShown()) {
        mFramesToDraw = kSettlingFrames;
    }
    mLongEdit.finish();
    bool mustRedraw = mViewport.update(mSession);
    if (mPlayback.advance(mInput.isWaiting())) { // the next picture is begun at once
        mustRedraw |= mViewport.update(mSession);
    }
    if (mustRedraw) {
        mFramesToDraw = std::max(mFramesToDraw, 1);
    }
    mTruth.update(mSession, mViewport.rect().size, mViewport.isAtRest(mSession));
    advanceScript();
    if (mOptions.state) {
        mScript.writeState(reportState(
            {mSession, mViewport, mFiles, mScript, mOpen.isRunning(), progress().isQuiet}));
    }
    if (mWindow.wantsClose()) {
        mWindow.cancelClose();
        mActions.quit();
        mFramesToDraw = kSettlingFrames;
    }
    const std::string name = std::filesystem::path(mSession.opened().model).filename().string();
    mWindow.setTitle(fmt::format("{}{} \xe2\x80\x94 Celadon",
                                 mSession.isAnythingModified() ? "*" : "",
                                 name.empty() ? "Celadon" : name));
}

Script::Progress Editor::progress() const {
    // What plays is never still: any picture of it will do.
    const bool isStill = mSession.motion.isPlaying
                             ? mViewport.shownRung() >= 0
                             : mViewport.isSettled(mSession) && mFramesToDraw == 0;
    const bool isTruthAwaited =
        mSession.view.mode.mode == ViewMode::Difference && !mTruth.isComplete(mSession);
    return {!mOpen.isRunning() && isStill && mJobs.isIdle() && !isTruthAwaited, !mJobs.isIdle(),
            mViewport.shownRevision()};
}

bool Editor::mustDraw() const {
    const glm::ivec2 size = mWindow.sizePx(); // zero while it is minimized
    return mFramesToDraw > 0 && size.x > 0 && size.y > 0;
}

double Editor::secondsToFrame() const {
    return std::chrono::duration<double>(mNextFrame - std::chrono::steady_clock::now()).count();
}

double Editor::secondsToSleep() const {
    if (mRecovery.isRunning()) {
        return 0.0;
    }
    if (mustDraw()) {
        return std::max(secondsToFrame(), 0.0);
    }
    if (!mOpen.isRunning() && mSession.hasWorld() && mScript.isReady(progress())) {
        return 0.0;
    }
    double seconds = mViewport.secondsToNextStep();
    const auto atMost = [&seconds](double most) {
        seconds = seconds < 0.0 ? most : std::min(seconds, most);
    };
    if (mOpen.isRunning() || mFiles.saving().isRunning() || mJobs.running()) {
        atMost(0.25); // the status bar shows how far it is
    }
    if (mPlayback.isOn()) {
        atMost(0.02);
    }
    if (!mSession.notices.empty()) {
        atMost(1.0); // they go when they are old
    }
    if (mOptions.watch) {
        atMost(kWatchSeconds);
    }
    return seconds;
}

void Editor::poll() {
    if (mOptions.watch && !mOpen.isRunning() && !mRecovery.isPending() && mSession.hasWorld() &&
        mWatch.hasChanged(mSession.opened())) {
        if (mSession.isModified()) {
            mSession.notify(Notice::Kind::Warning,
                            "A file changed on disk; it is not read again, since the material has "
                            "changes that are not saved");
        } else {
            // As the files are now, even if a recovery opened them as they had been.
            OpenRequest again = mSession.opened();
            again.readInstead.clear();
            mOpen.start(again);
        }
        mFramesToDraw = kSettlingFrames;
    }
    pollOpening();
    pollSaving();
    if (mRecovery.isRunning()) {
        const bool isDone = mRecovery.advance(mPreferences.autosave);
        mFramesToDraw = kSettlingFrames;
        if (isDone) {
            applyPreferences();
        }
    }
    if (mTools.takeArrived()) {
        mFramesToDraw = kSettlingFrames;
    }
    if (mSession.dropOldNotices(std::chrono::steady_clock::now())) {
        mFramesToDraw = kSettlingFrames;
    }
    if (mJobs.poll()) {
        mFramesToDraw = kSettlingFrames;
    }
    for (const std::string& problem : mJobs.takeErrors()) {
        mSession.notify(Notice::Kind::Error, problem);
        mFramesToDraw = kSettlingFrames;
    }
    if (const auto running = mJobs.running()) {
        mLayout.job = running;
        mFramesToDraw = std::max(mFramesToDraw, 1);
    } else if (mLayout.job) {
        mLayout.job.reset();
        mFramesToDraw = kSettlingFrames;
    }
    for (const std::filesystem::path& file : mWindow.takeDroppedFiles()) {
        if (mRecovery.isPending()) {
            mSession.notify(Notice::Kind::Info, "Drop it again when the recovery is done");
            continue;
        }
        mFiles.drop(file);
        mFramesToDraw = kSettlingFrames;
    }
    showActivity();
}

void Editor::pollOpening() {
    if (mViewport.shownRung() >= 0) {
        mSeenScene = mSession.opened();
    }
    if (!mOpen.poll()) {
        return;
    }
    mFramesToDraw = kSettlingFrames;
    if (!mOpen.isRunning() && mSession.worldRevision() == mSeenWorld) {
        mRecovery.sceneMissed();
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

void Editor::pollSaving() {
    if (mFiles.poll()) {
        mFramesToDraw = kSettlingFrames;
    }
}

std::string Editor::activity() const {
    if (mRecovery.isRunning()) {
        return mRecovery.activity();
    }
    if (mOpen.isRunning()) {
        return fmt::format("Opening {} \xe2\x80\xa6 {:.0f} s", mOpen.request().model,
                           mOpen.seconds());
    }
    if (const BackgroundSave& save = mFiles.saving(); save.isRunning() && save.seconds() > 0.3) {
        return fmt::format("Saving {} \xe2\x80\xa6 {:.0f} s", save.file().filename().string(),
                           save.seconds());
    }
    const std::optional<float> made = mViewport.tablesMade();
    if (made || mViewport.isPreparing()) {
        return "Preparing the picture \xe2\x80\xa6" +
               (made ? fmt::format(" {:.0f} %", 100.0f * *made) : "");
    }
    return {};
}

void Editor::showActivity() {
    std::string now = activity();
    if (now != mLayout.activity) {
        mLayout.activity = std::move(now);
        mFramesToDraw = std::max(mFramesToDraw, 1);
    }
    mLayout.canCancel = mOpen.isRunning() || mViewport.isPreparing();
}

void Editor::cancelJobs() {
    if (mOpen.isRunning()) {
        mOpen.cancel();
        mSession.notify(Notice::Kind::Info, "Opening was given up");
    } else if (mViewport.isPreparing()) { // what was there before comes back
        mFiles.open(mSeenScene);
    }
    mJobs.cancelShown();
    mTruth.giveUp();
}

void Editor::worldOpened() {
    mFiles.remember(mSession.opened());
    mJournal.begin(mSession.opened());
    mRecovery.sceneOpened();
    if (!mScript.isUnattended()) {
        mTools.prepare();
    }
}

void Editor::drawContents() {
    ImDrawList& background = *ImGui::GetBackgroundDrawList();
    const ViewportRect& rect = mViewport.rect();
    mViewport.draw(background);
    mTruth.draw(mSession, background, rect);
    if (!mViewport.isPreparing()) { // there is nothing yet to paint on
        mTools.drawOverlay(background, rect, mWindow.scale());
    }
    mLayout.isRecovering = mRecovery.isRunning();
    drawLayout({mSession, mLayout, mPreferences, mActions, mViewport, mThumbnails, mTruth, mTools,
                mWindow.scale()});
    mFiles.draw(mWindow.scale());
    mLongEdit.draw(mWindow.scale());
}

void Editor::showProgress(const std::string& title, float done) {
    // Of what ends within a frame, a stroke, nothing can be shown; a recovery has its own steps, of
    // which none may be left out.
    if (mIsDrawing || mRecovery.isRunning() || !mLongEdit.tell(title, done)) {
        return;
    }
    mWindow.waitEvents(0.0);
    if (const glm::ivec2 size = mWindow.sizePx(); size.x > 0 && size.y > 0) {
        drawFrame();
    }
    if (mLongEdit.isGivenUp()) {
        throw GivenUp(title);
    }
}

void Editor::composeFrame() {
    mIsDrawing = true;
    mWindow.beginFrame(); // throws where the context is lost: the journal keeps what was done
    const ViewportRect rect = viewportRect(mWindow.sizePx(), mLayout, mWindow.scale());
    mViewport.setRect(rect);
    mSession.aspect = rect.aspect();
    mLayout.hasPen = mWindow.hasPen();
    mInput.take(mWindow.takeInput());
    drawContents();
    mWindow.endFrame();
    mIsDrawing = false;
}

void Editor::drawFrame() {
    const auto begin = std::chrono::steady_clock::now();
    composeFrame();
    mWindow.present();
    if (mWindow.context().isSoftware()) {
        const auto end = std::chrono::steady_clock::now();
        // Under a stroke or a drag the picture comes first; who types wants to see it at once.
        const int share = ImGui::IsAnyMouseDown() ? 2 : 0;
        mNextFrame = std::max(begin + kSoftwareFrame, end + share * (end - begin));
    }
}

void Editor::takeScreenshot(const std::filesystem::path& file) {
    composeFrame();
    const glm::ivec2 size = mWindow.sizePx();
    const std::vector<unsigned char> pixels = mWindow.readBackBuffer();
    mWindow.present();
    writePicture(file, pixels, size);
}

void Editor::advanceScript() {
    if (mOpen.isRunning() || !mSession.hasWorld()) {
        return;
    }
    const Script::Step step = mScript.advance(progress());
    if (step.screenshot) {
        takeScreenshot(*step.screenshot);
    }
    if (step.isCommand) {
        mFramesToDraw = kSettlingFrames;
    }
    mShouldClose |= step.isOver;
}

} // namespace

void runEditor(const EditorOptions& options) {
    Editor editor(options);
    editor.run();
}

} // namespace celadon::ui
