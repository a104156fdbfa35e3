// What is set, not painted, and how it is undone, in one row with what was painted.
#include "ui/session.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace celadon::ui {

namespace {

/// The first that is not as it was, to be looked at; else the one that was chosen. Always one that
/// there is, or 0.
int changedLight(const std::vector<RigLight>& before, const std::vector<RigLight>& now,
                 int chosen) {
    const auto first = std::ranges::mismatch(before, now);
    if (first.in1 != before.end() || first.in2 != now.end()) {
        chosen = static_cast<int>(first.in2 - now.begin());
    }
    return std::clamp(chosen, 0, std::max(0, static_cast<int>(now.size()) - 1));
}

} // namespace

void Session::addStep(SettingPart before, const std::string& title, bool continues) {
    mSettingHistory.add(std::move(before), title, editCount(), continues);
    dropUndone();
}

void Session::changeMotion(MotionSetting next, const std::string& title, bool continues) {
    SettingPart before = MotionPart{motion.now.deformers, motion.now.animation};
    setMotion(std::move(next));
    addStep(std::move(before), title, continues);
}

void Session::changeLights(LightRig next, const std::string& title, bool continues) {
    SettingPart before = std::exchange(rig, std::move(next));
    addStep(std::move(before), title, continues);
    touchPicture();
}

void Session::changeProfile(bool isSecondary, NamedProfile next, const std::string& title,
                            bool continues) {
    NamedProfile& changed = isSecondary ? paint.secondary : paint.primary;
    SettingPart before = ProfilePart{isSecondary, std::exchange(changed, std::move(next))};
    addStep(std::move(before), title, continues);
}

void Session::dropUndone() {
    mSettingHistory.dropUndone();
    for (const auto& document : mDocuments) {
        if (document != nullptr) {
            document->dropUndone();
        }
    }
}

void Session::swapProfiles() {
    std::swap(paint.primary, paint.secondary);
    mSettingHistory.swapProfiles();
}

Camera Session::turnLights(double degrees) {
    Camera turned = camera;
    turnAround(turned, rig, degrees);
    mSettingHistory.turnLights(camera, degrees);
    for (std::vector<RigLight>* const lights : {&mFirstLights, &mSavedLights}) {
        turnAround(camera.at, *lights, degrees); // who only looks has changed nothing
    }
    return turned;
}

SettingPart Session::set(const SettingPart& part) {
    if (const auto* const moved = std::get_if<MotionPart>(&part)) {
        const MotionSetting before = motion.now;
        setMotion({moved->deformers, moved->animation, before.seconds});
        keepChoice(before.deformers);
        return MotionPart{before.deformers, before.animation};
    }
    if (const auto* const lights = std::get_if<LightRig>(&part)) {
        LightRig before = std::exchange(rig, *lights);
        selectedLight = changedLight(before.lights, rig.lights, selectedLight);
        followAnimation();
        touchPicture();
        return before;
    }
    const auto& held = std::get<ProfilePart>(part);
    NamedProfile& changed = held.isSecondary ? paint.secondary : paint.primary;
    return ProfilePart{held.isSecondary, std::exchange(changed, held.profile)};
}

std::optional<std::string> Session::undoTitle() const {
    if (const std::string* const title = mSettingHistory.undoTitle(editCount())) {
        return *title;
    }
    const int material = latestEdited();
    return material >= 0 ? std::optional(editTitle(*document(material)->undoCommand()))
                         : std::nullopt;
}

std::optional<std::string> Session::redoTitle() const {
    if (const std::string* const title = mSettingHistory.redoTitle(editCount())) {
        return *title;
    }
    const int material = nextRedone();
    return material >= 0 ? std::optional(editTitle(*document(material)->redoCommand()))
                         : std::nullopt;
}

Session::Undone Session::exchange(const SettingPart& part,
                                  void (SettingHistory::*confirm)(SettingPart)) {
    SettingPart before = set(SettingPart(part));
    const bool isWork = std::holds_alternative<MotionPart>(before);
    (mSettingHistory.*confirm)(std::move(before));
    return isWork ? Undone::Work : Undone::Setting;
}

Session::Undone Session::undo() {
    if (mSettingHistory.undoTitle(editCount()) == nullptr) {
        return undoEdit() ? Undone::Work : Undone::Nothing;
    }
    return exchange(mSettingHistory.undone(), &SettingHistory::confirmUndo);
}

Session::Undone Session::redo() {
    if (mSettingHistory.redoTitle(editCount()) == nullptr) {
        return redoEdit() ? Undone::Work : Undone::Nothing;
    }
    return exchange(mSettingHistory.redone(), &SettingHistory::confirmRedo);
}

} // namespace celadon::ui
