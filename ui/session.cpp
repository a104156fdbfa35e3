#include "ui/session.h"

#include "renderer/scene/camera.h"
#include "subedit/errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon::ui {

Session::Session(SessionServices services) : mServices(std::move(services)) {
    addBrushCommands(*this);
    addCameraCommands(*this);
    addFileCommands(*this);
    addLightCommands(*this);
    addMotionCommands(*this);
    addPaintCommands(*this);
    addProfileCommands(*this);
    addViewCommands(*this);
    paint.primary = {"Milky rose", diffusionProfile({0.92f, 0.62f, 0.55f}, {6.0f, 3.0f, 2.2f})};
    paint.secondary = {"Jade", diffusionProfile({0.42f, 0.74f, 0.55f}, {2.5f, 5.0f, 3.2f})};
}

bool Session::perform(const Command& command) {
    try {
        mDispatcher.execute(command);
        return true;
    } catch (const Error& error) {
        notify(Notice::Kind::Error, error.what());
        return false;
    }
}

void Session::notify(Notice::Kind kind, const std::string& text) {
    constexpr std::size_t kMostNotices = 4;
    std::erase_if(notices, [&](const Notice& notice) { return notice.text == text; });
    notices.push_back({kind, text});
    if (notices.size() > kMostNotices) {
        notices.erase(notices.begin());
    }
}

void Session::adopt(const OpenRequest& request, OpenedScene scene) {
    for (const std::string& warning : scene.world.warnings) {
        notify(Notice::Kind::Warning, warning);
    }
    const bool isSameModel = mWorld != nullptr && mOpened.model == request.model;
    mStrokeMaterial = -1;
    mShownWorld.reset();
    mMover.reset();
    mWorld = std::make_shared<const World>(std::move(scene.world));
    mRendered = std::move(scene.rendered);
    mDocuments = std::move(scene.documents);
    mOpened = request;
    activeMaterial = 0;
    materialFile.reset();
    if (request.material.ends_with(".subedit.exr")) {
        materialFile = request.material;
    }
    mSavedRevision = mMaterialRevision;
    if (!isSameModel) {
        camera = chooseCamera(*mWorld, {}, aspect);
        fileCamera = camera;
        const std::optional<RigEnvironment> environment = rig.environment;
        rig = {};
        rig.environment = environment;
        for (const Light& light : mWorld->lights) {
            rig.lights.push_back({lightKindName(light.kind), true, light});
        }
        if (rig.lights.empty()) {
            rig.lights = lightPreset("back", camera, mWorld->scatteringSphere);
        }
        selectedLight = 0;
        paint.brush.radiusMm = static_cast<float>(0.08 * mWorld->scatteringSphere.radius);
    }
    adoptMotion(isSameModel);
    ++mWorldRevision;
    touchPicture();
}

/// A model that is read again keeps its deformers, animation and time, as far as it still can.
void Session::adoptMotion(bool isSameModel) {
    mMover = std::make_unique<Motion>(*mWorld);
    MotionSetting stored;
    stored.deformers = mMover->deformers();
    const MotionState before = std::exchange(motion, {});
    motion.now = stored;
    if (isSameModel) {
        MotionSetting kept = before.now;
        if (kept.animation && *kept.animation >= mMover->animations().size()) {
            kept.animation.reset();
        }
        try {
            setMotion(std::move(kept));
            motion.isPlaying = before.isPlaying;
            motion.selected = before.selected;
            motion.control = before.control;
        } catch (const Error& error) {
            notify(Notice::Kind::Warning, error.what());
        }
    } else if (!mMover->animations().empty()) {
        stored.animation = 0;
        setMotion(std::move(stored));
    }
}

void Session::setMotion(MotionSetting next) {
    mMover->setDeformers(next.deformers);
    mMover->selectAnimation(next.animation);
    for (const std::string& warning : mMover->warnings()) {
        if (next.deformers != motion.now.deformers) {
            notify(Notice::Kind::Warning, warning);
        }
    }
    motion.now = std::move(next);
    touchPicture();
}

void Session::advanceTime(double seconds) {
    const double duration = hasWorld() ? mMover->durationSeconds() : 0.0;
    if (duration > 0.0) {
        motion.now.seconds = std::fmod(motion.now.seconds + seconds, duration);
        touchPicture();
    }
}

const std::shared_ptr<const World>& Session::shownWorld() {
    if (mMover->moves() && (!mShownWorld || mShownSetting != motion.now)) {
        try {
            mShownWorld = std::make_shared<const World>(
                posedWorld(*mWorld, mMover->at(motion.now.seconds)));
            mShownSetting = motion.now;
        } catch (const Error&) { // the picture says it
            return mWorld;
        }
    }
    return mMover->moves() ? mShownWorld : mWorld;
}

std::vector<std::shared_ptr<subedit::MaterialMap>> Session::takeRenderedMaterials() {
    return std::exchange(mRendered, {});
}

const subedit::Document* Session::document(int material) const {
    return material >= 0 && material < materialCount()
               ? mDocuments[static_cast<std::size_t>(material)].get()
               : nullptr;
}

subedit::Document* Session::document(int material) {
    return const_cast<subedit::Document*>(std::as_const(*this).document(material));
}

void Session::touchMaterial() {
    ++mMaterialRevision;
    touchPicture();
}

} // namespace celadon::ui
