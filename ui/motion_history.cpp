#include "ui/motion_history.h"

#include "subedit/assert.h"

#include <utility>

namespace celadon::ui {

void MotionHistory::clear() {
    mDone.clear();
    mUndone.clear();
}

void MotionHistory::add(const MotionSetting& before, const std::string& title, std::size_t edits,
                        bool continues) {
    const bool goesOn = continues && !mDone.empty() && mUndone.empty() &&
                        mDone.back().edits == edits && mDone.back().title == title;
    mUndone.clear();
    if (!goesOn) {
        mDone.push_back({before.deformers, before.animation, title, edits});
    }
}

const std::string* MotionHistory::undoTitle(std::size_t edits) const {
    return !mDone.empty() && edits <= mDone.back().edits ? &mDone.back().title : nullptr;
}

const std::string* MotionHistory::redoTitle(std::size_t edits) const {
    return !mUndone.empty() && edits == mUndone.back().edits ? &mUndone.back().title : nullptr;
}

MotionSetting MotionHistory::exchanged(const Step& step, const MotionSetting& now) {
    return {step.deformers, step.animation, now.seconds};
}

MotionSetting MotionHistory::undone(const MotionSetting& now) const {
    CELADON_ASSERT(!mDone.empty());
    return exchanged(mDone.back(), now);
}

MotionSetting MotionHistory::redone(const MotionSetting& now) const {
    CELADON_ASSERT(!mUndone.empty());
    return exchanged(mUndone.back(), now);
}

void MotionHistory::pass(std::vector<Step>& from, std::vector<Step>& to,
                         const MotionSetting& before) {
    to.push_back(std::move(from.back()));
    from.pop_back();
    to.back().deformers = before.deformers;
    to.back().animation = before.animation;
}

void MotionHistory::confirmUndo(const MotionSetting& before) {
    pass(mDone, mUndone, before);
}

void MotionHistory::confirmRedo(const MotionSetting& before) {
    pass(mUndone, mDone, before);
}

} // namespace celadon::ui
