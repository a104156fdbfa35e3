#pragma once

#include "renderer/output/tone_map.h"
#include "renderer/scene/motion.h"
#include "renderer/scene/world.h"
#include "renderer/shading/view_mode_pass.h"
#include "subedit/errors.h"
#include "ui/command.h"
#include "ui/light_rig.h"
#include "ui/motion_state.h"
#include "ui/opened_scene.h"
#include "ui/paint_state.h"
#include "ui/setting_history.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What is being worked on: model, materials, camera, lights, view, tools, and the commands that
/// change them. No window, no GL: widgets read it and make commands, the editor watches revisions.
namespace celadon::ui {

/// What to open. No material: the model's own, or the shipped default.
struct OpenRequest {
    std::string model;
    std::string material;
    /// Material files, by canonical path, and what is read in their place: how they were before a
    /// session that did not end well saved over them (journal.h).
    std::map<std::filesystem::path, std::filesystem::path> readInstead{};
    /// Of the bounding sphere of what scatters; none: as the program was told, or the file says.
    std::optional<double> diameterMm = std::nullopt;
    bool operator==(const OpenRequest&) const = default;
};

/// What the editor cannot do by itself, given by the program.
struct SessionServices {
    /// @throws celadon::Error
    std::function<World(const OpenRequest&)> readWorld;
    /// A material as a glTF has it, for viewers without SubEdit: `extras.subedit` is the reference.
    std::function<nlohmann::json(const subedit::MaterialMap&, const std::string& reference)>
        describeMaterial;
    bool isPaintable = true;
};

/// The user did not wait for the end of an edit.
struct GivenUp : Error {
    explicit GivenUp(const std::string& edit)
        : Error(edit, "was given up, and nothing has changed", {}, ExitCode::Failed) {}
};

/// A message to the user that can be dismissed.
struct Notice {
    enum class Kind { Info, Warning, Error };
    Kind kind = Kind::Info;
    std::string text;
    std::chrono::steady_clock::time_point since = std::chrono::steady_clock::now();
};

struct ViewState {
    ViewModeSettings mode;
    float exposureEv = 0.0f;
    ToneMap toneMap = ToneMap::Neutral;
    bool specular = true;
};

class Session {
public:
    explicit Session(SessionServices services);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Executes; what goes wrong becomes a notice. For widgets and keys, in the middle of a frame:
    /// with somebody to tell, commands that may take long wait for its end (performWaiting()).
    /// @return whether it was done, or waits
    bool perform(const Command& command);
    /// The same for more than a command that may take long.
    bool performLong(std::function<void()> action);
    /// The same as perform(), at once. For what is replayed in an order of its own.
    bool performNow(const Command& command);
    void performWaiting();
    /// Something waits: what comes later must not overtake it.
    [[nodiscard]] bool hasWaiting() const { return !mWaiting.empty(); }
    /// Called now and then while an edit lasts, with its title and how much is done, 0 to 1 or
    /// below 0 where nobody knows. It must not change the session; what it throws ends the edit and
    /// leaves the material as it was. Empty: nobody asks.
    std::function<void(const std::string& title, float done)> onProgress;
    [[nodiscard]] subedit::EditProgress progressOf(const std::string& title) const;
    /// The same, throwing. For replays and tests. @throws celadon::Error
    void execute(const Command& command) { mDispatcher.execute(command); }
    [[nodiscard]] Dispatcher& dispatcher() { return mDispatcher; }
    [[nodiscard]] const SessionServices& services() const { return mServices; }

    /// How much memory the history of each document may take, from now on.
    void setHistoryBytes(std::size_t bytes);

    /// A scene that was read elsewhere becomes the one that is worked on.
    void adopt(const OpenRequest& request, OpenedScene scene);
    /// The model as large as this (session_size.cpp). Materials and selections stay as they are,
    /// camera, lights and deformers go along; what was done before can no longer be undone. May
    /// take a second.
    /// @throws celadon::Error; nothing changes
    void resize(double diameterMm);

    [[nodiscard]] bool hasWorld() const { return mWorld != nullptr; }
    /// Its materials belong to the picture's thread: documents have what is edited.
    [[nodiscard]] const World& world() const { return *mWorld; }
    [[nodiscard]] const std::shared_ptr<const World>& sharedWorld() const { return mWorld; }
    [[nodiscard]] const OpenRequest& opened() const { return mOpened; }
    /// Maps of the world just adopted; once.
    [[nodiscard]] std::vector<std::shared_ptr<subedit::MaterialMap>> takeRenderedMaterials();

    // Painting (paint_commands.cpp).
    [[nodiscard]] int materialCount() const { return static_cast<int>(mDocuments.size()); }
    /// Null where there is none to paint on.
    [[nodiscard]] subedit::Document* document(int material);
    [[nodiscard]] const subedit::Document* document(int material) const;
    [[nodiscard]] subedit::Document* activeDocument() { return document(activeMaterial); }
    [[nodiscard]] const subedit::Document* activeDocument() const {
        return document(activeMaterial);
    }
    /// An edit of the active material by the tool in hand, recorded as what it came to.
    /// @throws celadon::Error
    void edit(const subedit::EditCommand& command);
    /// On which sides of the object strokes, scribbles and stamps are repeated.
    [[nodiscard]] subedit::Mirror mirror() const;
    /// A stroke as it happens. Its end is the command that a replay repeats.
    void beginStroke(int material, const subedit::StrokePoint& point, bool inverted);
    void addStrokePoint(const subedit::StrokePoint& point);
    /// With somebody to tell, what is worked out only now waits for the end of the frame.
    void endStroke();
    void cancelStroke();
    [[nodiscard]] bool isStrokeOpen() const { return mStrokeMaterial >= 0; }
    /// Notices about what an edit ran into.
    void tell(const subedit::EditReport& report, bool isSelection);
    /// After anything that changed a document's content.
    void touchMaterial();
    /// There are edits that can no longer be undone.
    [[nodiscard]] bool isAnyForgotten() const { return latestEdited() < 0 && editCount() > 0; }

    // Saving (session_materials.cpp).
    [[nodiscard]] bool isModified(int material) const;
    /// Any of them.
    [[nodiscard]] bool isModified() const;
    /// @param content Document::contentId() of what is in the file
    void markSaved(int material, std::uint64_t content);
    /// Where Save writes; empty: nobody has said yet.
    [[nodiscard]] const std::filesystem::path& materialFile(int material) const {
        return mFiles[static_cast<std::size_t>(material)];
    }
    void setMaterialFile(int material, const std::filesystem::path& file) {
        mFiles[static_cast<std::size_t>(material)] = file;
    }
    /// Nothing takes a file's name unless asked to.
    void forgetMaterialFiles();
    // Motion (session_motion.cpp).
    /// Shows the model so from now on. @throws celadon::Error where it cannot be; nothing changes
    void setMotion(MotionSetting next);
    /// Which deformer, and which of its controls, the panel and the viewport show; -1: none.
    void chooseDeformer(int index, int control = -1);
    /// While it plays: time goes on, and starts over after the end where it loops.
    /// @return whether it goes on: false at the end, and where nothing changes over time
    bool advanceTime(double clockSeconds);
    /// The motion of the world as it is set now; handles are solved when it is asked for a pose.
    [[nodiscard]] const Motion& mover() const { return *mMover; }
    [[nodiscard]] bool areDeformersModified() const {
        return motion.now.deformers != mSavedDeformers;
    }
    void markDeformersSaved() { mSavedDeformers = motion.now.deformers; }
    /// Other lights than those that the model brought, or got.
    [[nodiscard]] bool areLightsOther() const { return !areSame(rig.lights, mFirstLights); }
    /// Lights that no file has: only exports keep them.
    [[nodiscard]] bool areLightsModified() const { return !areSame(rig.lights, mSavedLights); }
    void markLightsSaved() { mSavedLights = rig.lights; }
    /// Of any kind.
    [[nodiscard]] bool isAnythingModified() const {
        return isModified() || areDeformersModified() || areLightsModified();
    }

    // What can be undone (session_settings.cpp).
    /// Steps that set what is not painted. @param continues see SettingHistory::add
    void changeMotion(MotionSetting next, const std::string& title, bool continues = false);
    void changeLights(LightRig next, const std::string& title, bool continues = false);
    void changeProfile(bool isSecondary, NamedProfile next, const std::string& title,
                       bool continues = false);
    /// No steps: they go on in what is undone.
    void swapProfiles();
    /// About the camera's target. @return the camera turned with them
    [[nodiscard]] Camera turnLights(double degrees);
    /// What undo() and redo() would do; nothing: there is nothing.
    [[nodiscard]] std::optional<std::string> undoTitle() const;
    [[nodiscard]] std::optional<std::string> redoTitle() const;
    /// After a step: nothing that was undone before it can be redone.
    void dropUndone();
    /// What was set so far is how the scene opens: no steps.
    void forgetSettings() { mSettingHistory.clear(); }
    /// Of what was undone: what a session must not lose, materials and motion, or how they are
    /// looked at and painted on.
    enum class Undone { Nothing, Work, Setting };
    /// Takes back the latest step, of all materials and settings; repeats the first that was taken
    /// back. An edit's material becomes the active one.
    Undone undo();
    Undone redo();

    // State that commands change and widgets read.
    bool isHeld = false; ///< a slider is in the hand: its changes are one step to be undone
    MotionState motion;  ///< `now` is set by setMotion() and advanceTime() alone
    Camera camera;
    std::optional<Camera> fileCamera; ///< the view that the scene opens with
    LightRig rig;
    int selectedLight = 0;
    ViewState view;
    PaintState paint;
    int activeMaterial = 0;
    double aspect = 16.0 / 9.0; ///< of the viewport; set by the window
    std::vector<Notice> notices;
    /// Told of each material file before it is written: what stands there may be worth keeping.
    std::function<void(const std::filesystem::path&)> beforeWriting;
    /// Told before the model becomes another size: what is being written should be finished.
    std::function<void()> beforeResizing;

    void notify(Notice::Kind kind, const std::string& text);
    /// What cannot be done so is a warning, what failed an error.
    void notify(const Error& error);
    /// Those that were there long enough to be read; errors stay. @return whether there were any
    bool dropOldNotices(std::chrono::steady_clock::time_point now);

    /// Grows with every change of what the viewport shows, except its size.
    [[nodiscard]] std::uint64_t pictureRevision() const { return mPictureRevision; }
    void touchPicture() { ++mPictureRevision; }
    /// Grows when another world is opened.
    [[nodiscard]] std::uint64_t worldRevision() const { return mWorldRevision; }

private:
    /// A model that is read again keeps its motion, as far as it still can.
    void adoptMotion(bool isSameModel);
    /// The model's camera and lights that nobody has moved go along with its animation.
    void followAnimation();
    /// What was chosen stays so where the list has it still.
    void keepChoice(const DeformerStack& before);
    /// @return the same part as it was
    SettingPart set(const SettingPart& part);
    /// Sets what a step had before it, and tells the history that it was done.
    Undone exchange(const SettingPart& part, void (SettingHistory::*confirm)(SettingPart));
    void addStep(SettingPart before, const std::string& title, bool continues);
    /// What stands about a model that becomes so many times as large goes along, so that it looks
    /// as before.
    void scaleSurroundings(double factor);
    /// The latest edit of all materials, or the first that was taken back. @return whether there
    /// was any
    bool undoEdit();
    bool redoEdit();
    /// What it throws becomes a notice. @return whether it threw nothing
    bool attempt(const std::function<void()>& action);
    /// The stroke in hand.
    struct Stroke {
        subedit::StrokeCommand command; ///< its operator does not matter where it selects
        bool isInverted = false;
        bool selects = false; ///< its paint is selection
        bool isLive = false;  ///< the material follows; else all is done at the end
    };
    void finishStroke(int material, const Stroke& stroke);
    /// Of all documents, in effect.
    [[nodiscard]] std::size_t editCount() const;
    /// Whose edit is the latest, or was taken back last; -1: none.
    [[nodiscard]] int latestEdited() const;
    [[nodiscard]] int nextRedone() const;
    /// Files and saved states of documents just opened.
    void adoptFiles(const OpenRequest& request);

    SessionServices mServices;
    Dispatcher mDispatcher;
    std::shared_ptr<const World> mWorld;
    std::unique_ptr<Motion> mMover;        ///< of mWorld
    std::optional<Camera> mFollowedCamera; ///< the model's first, as it was last
    SettingHistory mSettingHistory;
    DeformerStack mSavedDeformers;
    std::vector<RigLight> mFirstLights, mSavedLights;
    OpenRequest mOpened;
    std::vector<std::shared_ptr<subedit::MaterialMap>> mRendered;
    std::vector<std::unique_ptr<subedit::Document>> mDocuments;
    std::vector<std::filesystem::path> mFiles; ///< of each, or empty
    static constexpr std::uint64_t kSavedNever = ~std::uint64_t{0};
    std::vector<std::uint64_t> mSaved;        ///< Document::contentId() of what is in the file
    std::optional<std::size_t> mHistoryBytes; ///< of each; else their default
    int mStrokeMaterial = -1;                 ///< of the open stroke
    Stroke mStroke;
    std::vector<std::function<void()>> mWaiting; ///< for the end of the frame
    std::uint64_t mPictureRevision = 1;
    std::uint64_t mWorldRevision = 0;
};

// Each file of commands registers its own (camera_commands.cpp and so on).
void addBrushCommands(Session& session);
void addCameraCommands(Session& session);
void addDeformCommands(Session& session);
void addFileCommands(Session& session);
void addLightCommands(Session& session);
void addMotionCommands(Session& session);
void addPaintCommands(Session& session);
void addProfileCommands(Session& session);
void addSpreadCommands(Session& session);
void addViewCommands(Session& session);

} // namespace celadon::ui
