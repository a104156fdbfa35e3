#pragma once

#include "renderer/output/tone_map.h"
#include "renderer/scene/world.h"
#include "renderer/shading/view_mode_pass.h"
#include "ui/command.h"
#include "ui/light_rig.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What is being worked on: model, material, camera, lights, view, tools, and the commands that
/// change them. No window, no GL: widgets read it and make commands, the editor watches revisions.
namespace celadon::ui {

/// What to open. Empty: builtin model, the model's own material or the shipped default.
struct OpenRequest {
    std::string model;
    std::string material;
};

/// What the editor cannot do by itself, given by the program.
struct SessionServices {
    /// @throws celadon::Error
    std::function<World(const OpenRequest&)> readWorld;
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

    /// Executes; what goes wrong becomes a notice. For widgets and keys.
    /// @return whether it was done
    bool perform(const Command& command);
    /// The same, throwing. For replays and tests. @throws celadon::Error
    void execute(const Command& command) { mDispatcher.execute(command); }
    [[nodiscard]] Dispatcher& dispatcher() { return mDispatcher; }
    [[nodiscard]] const SessionServices& services() const { return mServices; }

    /// A world that was read elsewhere becomes the one that is worked on.
    void adopt(const OpenRequest& request, World world);

    [[nodiscard]] bool hasWorld() const { return mWorld != nullptr; }
    [[nodiscard]] const World& world() const { return *mWorld; }
    [[nodiscard]] const std::shared_ptr<const World>& sharedWorld() const { return mWorld; }
    [[nodiscard]] const OpenRequest& opened() const { return mOpened; }

    // State that commands change and widgets read.
    Camera camera;
    std::optional<Camera> fileCamera; ///< the view that the scene opens with
    LightRig rig;
    int selectedLight = 0;
    ViewState view;
    double aspect = 16.0 / 9.0; ///< of the viewport; set by the window
    std::vector<Notice> notices;

    void notify(Notice::Kind kind, const std::string& text);

    /// Grows with every change of what the viewport shows, except its size.
    [[nodiscard]] std::uint64_t pictureRevision() const { return mPictureRevision; }
    void touchPicture() { ++mPictureRevision; }
    /// Grows when another world is opened.
    [[nodiscard]] std::uint64_t worldRevision() const { return mWorldRevision; }

private:
    SessionServices mServices;
    Dispatcher mDispatcher;
    std::shared_ptr<const World> mWorld;
    OpenRequest mOpened;
    std::uint64_t mPictureRevision = 1;
    std::uint64_t mWorldRevision = 0;
};

// Each file of commands registers its own (camera_commands.cpp and so on).
void addCameraCommands(Session& session);
void addLightCommands(Session& session);
void addViewCommands(Session& session);
void addFileCommands(Session& session);

} // namespace celadon::ui
