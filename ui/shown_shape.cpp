#include "ui/shown_shape.h"

#include "subedit/errors.h"
#include "ui/window.h"

#include <chrono>
#include <utility>

namespace celadon::ui {

namespace {

/// What comes within this is as good as there: within a frame of any display.
constexpr std::chrono::milliseconds kUnseen{4};

} // namespace

ShownShapes::Poser::Poser(std::shared_ptr<const World> world)
    : rest(std::move(world)), motion(*rest) {}

std::shared_ptr<const ShownShape> ShownShapes::make(Poser& poser, const MotionSetting& setting) {
    if (!poser.restRays) {
        poser.restRays = std::make_shared<const RayScene>(*poser.rest);
    }
    auto shape = std::make_shared<ShownShape>();
    shape->rest = shape->world = poser.rest;
    shape->restRays = shape->rays = poser.restRays;
    shape->setting = setting;
    try {
        poser.motion.setDeformers(setting.deformers);
        poser.motion.selectAnimation(setting.animation);
        if (poser.motion.moves()) {
            shape->world = std::make_shared<const World>(
                posedWorld(*poser.rest, poser.motion.at(setting.seconds)));
            shape->rays = std::make_shared<const RayScene>(*shape->world);
        }
    } catch (const Error&) { // the picture says it
        shape->world = poser.rest;
    }
    return shape;
}

bool ShownShapes::isOfNow(const ShownShape& shape) const {
    return shape.rest == mSession.sharedWorld() && shape.setting == mSession.motion.now;
}

void ShownShapes::begin() {
    if (!mPoser || mPoser->rest != mSession.sharedWorld()) {
        mPoser = std::make_shared<Poser>(mSession.sharedWorld());
    }
    std::packaged_task<std::shared_ptr<const ShownShape>()> task(
        [poser = mPoser, setting = mSession.motion.now] { return make(*poser, setting); });
    mComing = task.get_future();
    mThread = std::jthread([task = std::move(task)]() mutable {
        task();
        Window::wake(); // once it can be taken: nobody looks again before
    });
}

void ShownShapes::take() {
    mLatest = mComing.get();
    mHasArrived = true;
}

bool ShownShapes::isCurrent() {
    if (!mSession.hasWorld()) {
        return false;
    }
    const auto isThere = [this](std::chrono::milliseconds patience) {
        if (mComing.valid() && mComing.wait_for(patience) == std::future_status::ready) {
            take();
        }
        return mLatest && isOfNow(*mLatest);
    };
    if (isThere({})) {
        return true;
    }
    if (!mComing.valid()) {
        begin();
    }
    return isThere(kUnseen);
}

const ShownShape* ShownShapes::current() {
    while (mSession.hasWorld() && !isCurrent()) {
        if (mComing.valid()) {
            take();
        }
    }
    return mSession.hasWorld() ? mLatest.get() : nullptr;
}

bool ShownShapes::takeArrived() {
    if (mComing.valid() && mComing.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        take();
    }
    return std::exchange(mHasArrived, false);
}

} // namespace celadon::ui
