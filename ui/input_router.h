#pragma once

#include "ui/file_actions.h"
#include "ui/layout_state.h"
#include "ui/panels/long_edit.h"
#include "ui/recovery_run.h"
#include "ui/window.h"

#include <functional>
#include <vector>

/// Where what the hand does goes: to a key's action, to the tools of the viewport, or to the next
/// frame.
namespace celadon::ui {

class InputRouter {
public:
    struct Targets {
        Session& session;
        ViewportTools& tools;
        const Viewport& viewport;
        LayoutState& layout;
        const Preferences& preferences;
        const RecoveryRun& recovery;
        const FileActions& files;
        const LongEdit& longEdit;
        std::function<void(Action)> act;
    };
    explicit InputRouter(const Targets& targets) : mTargets(targets) {}

    /// Within a frame of ImGui, before anything is drawn.
    void take(const std::vector<InputEvent>& events);
    /// Something waits for the next frame.
    [[nodiscard]] bool isWaiting() const { return !mLater.empty(); }

private:
    void takeKey(KeyChord pressed);
    void handleKey(const InputEvent& event);
    [[nodiscard]] bool mustWait(const InputEvent& event, bool overUi);

    Targets mTargets;
    std::vector<InputEvent> mLater; ///< for the next frame
};

} // namespace celadon::ui
