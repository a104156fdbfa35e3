// What moves the model.
#include "renderer/scene/handle_ground.h"
#include "renderer/scene/motion.h"
#include "subedit/document/edit_progress.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon::ui {

namespace {

bool areAtOnePlace(const Camera& a, const Camera& b) {
    return a.eye == b.eye && a.at == b.at && a.up == b.up;
}

} // namespace

void Session::adoptMotion(bool isSameModel) {
    mMover = std::make_unique<Motion>(*mWorld);
    mSettingHistory.clear();
    const MotionState before = std::exchange(motion, {});
    motion.now.deformers = mMover->deformers();
    motion.speed = before.speed;
    motion.loops = before.loops;
    if (!isSameModel) {
        mFollowedCamera.reset();
        mSavedDeformers = motion.now.deformers;
        for (const std::string& warning : mMover->warnings()) {
            notify(Notice::Kind::Warning, warning);
        }
        if (!mMover->animations().empty()) {
            motion.now.animation = 0;
            mMover->selectAnimation(0);
        }
        followAnimation();
        return;
    }
    MotionSetting kept = before.now;
    if (kept.animation && *kept.animation >= mMover->animations().size()) {
        kept.animation.reset();
    }
    try {
        setMotion(std::move(kept));
        motion.isPlaying = before.isPlaying;
        motion.selected = before.selected;
        motion.control = before.control;
    } catch (const Error& error) { // the shape has changed so that they do not fit any more
        notify(Notice::Kind::Warning, error.what());
    }
}

void Session::setMotion(MotionSetting next) {
    const bool isChanged = next.deformers != motion.now.deformers;
    if (const auto handles = mMover->handlesNewIn(next.deformers);
        !handles.empty() && mWorld->handleGround) { // for a large model, a long job
        subedit::doTelling(progressOf("preparing handles"), [&] {
            static_cast<void>(mWorld->handleGround->nodes(*mWorld, handles));
        });
    }
    mMover->setDeformers(next.deformers);
    mMover->selectAnimation(next.animation);
    motion.now = std::move(next);
    followAnimation();
    touchPicture();
    if (isChanged) {
        for (const std::string& warning : mMover->warnings()) {
            notify(Notice::Kind::Warning, warning);
        }
    }
}

bool Session::advanceTime(double clockSeconds) {
    const double duration = hasWorld() ? mMover->durationSeconds() : 0.0;
    if (duration <= 0.0) {
        return false;
    }
    const double next = motion.now.seconds + motion.speed * clockSeconds;
    motion.now.seconds =
        next <= duration ? next : (motion.loops ? std::fmod(next, duration) : duration);
    followAnimation();
    touchPicture();
    return motion.loops || next < duration;
}

void Session::followAnimation() {
    if (!mWorld->rig || (mWorld->cameras.empty() && mWorld->lights.empty())) {
        return;
    }
    const Viewpoints now = mMover->viewpointsAt(motion.now.seconds);
    for (RigLight& item : rig.lights) {
        if (item.followed) {
            item.light.position = now.lights[*item.followed].position;
            item.light.direction = now.lights[*item.followed].direction;
        }
    }
    if (now.cameras.empty()) {
        return;
    }
    const Camera& atRest = mWorld->cameras.front();
    const Camera before = mFollowedCamera.value_or(atRest);
    for (Camera* const followed : {&camera, fileCamera ? &*fileCamera : nullptr}) {
        if (followed != nullptr &&
            (areAtOnePlace(*followed, before) || areAtOnePlace(*followed, atRest))) {
            followed->eye = now.cameras.front().eye;
            followed->at = now.cameras.front().at;
            followed->up = now.cameras.front().up;
        }
    }
    mFollowedCamera = now.cameras.front();
}

void Session::keepChoice(const DeformerStack& before) {
    const auto index = static_cast<std::size_t>(motion.selected);
    const DeformerStack& now = motion.now.deformers;
    if (motion.selected < 0 || index >= std::min(before.size(), now.size()) ||
        before[index].kind != now[index].kind) {
        chooseDeformer(-1);
    } else if (now[index].kind == Deformer::Kind::Handles &&
               motion.control >= static_cast<int>(now[index].handles.size())) {
        motion.control = -1;
    }
}

void Session::chooseDeformer(int index, int control) {
    motion.selected = index;
    motion.control = control;
}

} // namespace celadon::ui
