#include "ui/key_actions.h"

#include <imgui.h>
#include <imgui_internal.h> // ClosePopupsExceptModals

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr double kTurnDegrees = 15.0;
constexpr double kResize = 1.15;
constexpr double kStepsPerSecond = 24.0;

/// Keys that are one command, whatever else there is.
struct FixedCommand {
    Action action;
    const char* command;
    const char* argument; ///< null: none
    const char* value;
};
constexpr std::array kFixed{
    FixedCommand{Action::Undo, "edit.undo", nullptr, nullptr},
    FixedCommand{Action::Redo, "edit.redo", nullptr, nullptr},
    FixedCommand{Action::Swap, "profile.swap", nullptr, nullptr},
    FixedCommand{Action::Front, "camera.view", "name", "front"},
    FixedCommand{Action::Right, "camera.view", "name", "right"},
    FixedCommand{Action::Top, "camera.view", "name", "top"},
    FixedCommand{Action::Back, "camera.view", "name", "back"},
    FixedCommand{Action::Left, "camera.view", "name", "left"},
    FixedCommand{Action::Bottom, "camera.view", "name", "bottom"},
    FixedCommand{Action::Initial, "camera.view", "name", "initial"},
    FixedCommand{Action::Paint, "tool.choose", "name", "paint"},
    FixedCommand{Action::Select, "tool.choose", "name", "select"},
    FixedCommand{Action::SelectAll, "select.change", "what", "all"},
    FixedCommand{Action::SelectNone, "select.change", "what", "none"},
    FixedCommand{Action::SelectInvert, "select.change", "what", "invert"},
};

void turn(Session& session, double azimuth, double elevation) {
    session.perform({"camera.orbit", {{"azimuth", azimuth}, {"elevation", elevation}}});
}

void resizeBrush(Session& session, double factor) {
    const double radius = static_cast<double>(session.paint.brush.radiusMm);
    session.perform({"brush.change", {{"radius", radius * factor}}});
}

void pickProfile(const KeyTargets& t) {
    if (const auto hit = t.tools.pick(t.tools.cursor(), t.viewport); hit && hit->material >= 0) {
        t.session.perform(
            {"profile.pick", {{"material", hit->material}, {"uv", {hit->uv.x, hit->uv.y}}}});
    }
}

/// To the next or the last whole frame, standing still.
void step(Session& session, double frames) {
    if (session.hasWorld()) {
        const double frame = std::round(session.motion.now.seconds * kStepsPerSecond) + frames;
        session.perform(
            {"motion.play", {{"on", false}, {"seconds", std::max(frame, 0.0) / kStepsPerSecond}}});
    }
}

void setKey(const KeyTargets& t) {
    const MotionState& motion = t.session.motion;
    if (t.layout.tab == Tab::Deform && motion.selected >= 0) {
        t.session.perform({"deform.key",
                           {{"deformer", motion.selected},
                            {"control", motion.control},
                            {"seconds", motion.now.seconds}}});
    }
}

/// Gives up what the hand does and closes what is open; where there is nothing, the newest notice.
void cancel(const KeyTargets& t) {
    const bool isMenuOpen =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool isAnyOpen = isMenuOpen || t.layout.helpShown || t.layout.preferencesShown ||
                           t.tools.isDragging() || t.tools.isAdjusting() ||
                           t.session.motion.isAddingHandles;
    if (!isAnyOpen && !t.session.notices.empty()) {
        t.session.notices.pop_back();
    }
    ImGui::ClosePopupsExceptModals(); // lists, a color picker
    t.layout.openMenu = "none";
    t.layout.helpShown = false;
    t.layout.preferencesShown = false;
    t.tools.cancel();
}

} // namespace

void performAction(Action action, const KeyTargets& t) {
    for (const FixedCommand& fixed : kFixed) {
        if (fixed.action == action) {
            Command command{fixed.command};
            if (fixed.argument != nullptr) {
                command.arguments[fixed.argument] = fixed.value;
            }
            t.session.perform(command);
            return;
        }
    }
    switch (action) {
    case Action::Help:
        t.layout.helpShown = !t.layout.helpShown;
        break;
    case Action::Panels:
        t.layout.panelsShown = !t.layout.panelsShown;
        if (!t.layout.panelsShown) {
            t.session.notify(Notice::Kind::Info,
                             t.keys.text(Action::Panels) + " brings the panels back");
        }
        break;
    case Action::FullScreen:
        t.actions.toggleFullScreen();
        break;
    case Action::Quit:
        t.actions.quit();
        break;
    case Action::Pick:
        pickProfile(t);
        break;
    case Action::Radius:
        t.tools.beginAdjust(ViewportTools::Adjust::Radius);
        break;
    case Action::Strength:
        t.tools.beginAdjust(ViewportTools::Adjust::Strength);
        break;
    case Action::Smaller:
        resizeBrush(t.session, 1.0 / kResize);
        break;
    case Action::Larger:
        resizeBrush(t.session, kResize);
        break;
    case Action::Frame:
        t.session.perform({"camera.frame", {{"aspect", t.session.aspect}}});
        break;
    case Action::Projection:
        t.session.perform({"camera.projection",
                           {{"orthographic", !t.session.camera.orthographicHeight.has_value()}}});
        break;
    case Action::TurnLeft:
        turn(t.session, kTurnDegrees, 0.0);
        break;
    case Action::TurnRight:
        turn(t.session, -kTurnDegrees, 0.0);
        break;
    case Action::TurnUp:
        turn(t.session, 0.0, kTurnDegrees);
        break;
    case Action::TurnDown:
        turn(t.session, 0.0, -kTurnDegrees);
        break;
    case Action::Cancel:
        cancel(t);
        break;
    case Action::Save:
        t.actions.save();
        break;
    case Action::SaveAs:
        t.actions.saveAs();
        break;
    case Action::Open:
        t.actions.openModel();
        break;
    case Action::Play:
        t.actions.togglePlay();
        break;
    case Action::Turntable:
        t.actions.toggleTurntable();
        break;
    case Action::StepBack:
        step(t.session, -1.0);
        break;
    case Action::StepOn:
        step(t.session, 1.0);
        break;
    case Action::Key:
        setKey(t);
        break;
    default:
        break;
    }
}

} // namespace celadon::ui
