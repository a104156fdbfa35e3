#include "ui/setting_history.h"

#include "subedit/assert.h"

#include <utility>

namespace celadon::ui {

void SettingHistory::clear() {
    mDone.clear();
    mUndone.clear();
}

void SettingHistory::add(SettingPart before, const std::string& title, std::size_t edits,
                         bool continues) {
    constexpr std::size_t kMostSteps = 1000;
    const bool goesOn = continues && !mDone.empty() && mUndone.empty() &&
                        mDone.back().edits == edits && mDone.back().title == title;
    mUndone.clear();
    if (!goesOn) {
        mDone.push_back({std::move(before), title, edits});
        if (mDone.size() > kMostSteps) {
            mDone.erase(mDone.begin());
        }
    }
}

const std::string* SettingHistory::undoTitle(std::size_t edits) const {
    return !mDone.empty() && edits <= mDone.back().edits ? &mDone.back().title : nullptr;
}

const std::string* SettingHistory::redoTitle(std::size_t edits) const {
    return !mUndone.empty() && edits == mUndone.back().edits ? &mUndone.back().title : nullptr;
}

const SettingPart& SettingHistory::undone() const {
    CELADON_ASSERT(!mDone.empty());
    return mDone.back().part;
}

const SettingPart& SettingHistory::redone() const {
    CELADON_ASSERT(!mUndone.empty());
    return mUndone.back().part;
}

void SettingHistory::pass(std::vector<Step>& from, std::vector<Step>& to, SettingPart before) {
    to.push_back(std::move(from.back()));
    from.pop_back();
    to.back().part = std::move(before);
}

void SettingHistory::confirmUndo(SettingPart before) {
    pass(mDone, mUndone, std::move(before));
}

void SettingHistory::confirmRedo(SettingPart before) {
    pass(mUndone, mDone, std::move(before));
}

template<class Part, class Change>
void SettingHistory::forEach(const Change& change) {
    for (std::vector<Step>* const steps : {&mDone, &mUndone}) {
        for (Step& step : *steps) {
            if (Part* const part = std::get_if<Part>(&step.part)) {
                change(*part);
            }
        }
    }
}

void SettingHistory::swapProfiles() {
    forEach<ProfilePart>([](ProfilePart& part) { part.isSecondary = !part.isSecondary; });
}

void SettingHistory::turnLights(const Camera& camera, double degrees) {
    forEach<LightRig>([&](LightRig& rig) {
        Camera turned = camera;
        turnAround(turned, rig, degrees);
    });
}

} // namespace celadon::ui
