#include "ui/session.h"

#include "renderer/scene/camera.h"
#include "renderer/scene/light.h"
#include "subedit/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace celadon::ui {

Session::Session(SessionServices services) : mServices(std::move(services)) {
    addBrushCommands(*this);
    addCameraCommands(*this);
    addDeformCommands(*this);
    addFileCommands(*this);
    addLightCommands(*this);
    addMotionCommands(*this);
    addPaintCommands(*this);
    addProfileCommands(*this);
    addSpreadCommands(*this);
    addViewCommands(*this);
    paint.primary = {"Milky rose", diffusionProfile({0.92f, 0.62f, 0.55f}, {6.0f, 3.0f, 2.2f})};
    paint.secondary = {"Jade", diffusionProfile({0.42f, 0.74f, 0.55f}, {2.5f, 5.0f, 3.2f})};
}

bool Session::perform(const Command& command) {
    // What is not long itself comes after what waits.
    return mDispatcher.isLong(command.name) || !mWaiting.empty()
               ? performLong([this, command] { mDispatcher.execute(command); })
               : performNow(command);
}

bool Session::performLong(std::function<void()> action) {
    if (!onProgress) {
        return attempt(action);
    }
    mWaiting.push_back(std::move(action));
    return true;
}

bool Session::performNow(const Command& command) {
    return attempt([&] { mDispatcher.execute(command); });
}

void Session::performWaiting() {
    for (const std::function<void()>& action : std::exchange(mWaiting, {})) {
        attempt(action);
    }
}

bool Session::attempt(const std::function<void()>& action) {
    try {
        action();
        return true;
    } catch (const GivenUp& givenUp) {
        notify(Notice::Kind::Info, givenUp.what());
    } catch (const Error& error) {
        notify(error);
    }
    return false;
}

void Session::notify(Notice::Kind kind, const std::string& text) {
    constexpr std::size_t kMostNotices = 4;
    std::erase_if(notices, [&](const Notice& notice) { return notice.text == text; });
    notices.push_back({kind, text});
    if (notices.size() > kMostNotices) {
        notices.erase(notices.begin());
    }
}

void Session::notify(const Error& error) {
    const bool isRefused = error.exitCode() == ExitCode::Usage;
    notify(isRefused ? Notice::Kind::Warning : Notice::Kind::Error, error.what());
}

bool Session::dropOldNotices(std::chrono::steady_clock::time_point now) {
    using namespace std::chrono_literals;
    return std::erase_if(notices, [now](const Notice& notice) {
               return notice.kind != Notice::Kind::Error &&
                      now - notice.since > (notice.kind == Notice::Kind::Info ? 8s : 20s);
           }) > 0;
}

void Session::adopt(const OpenRequest& request, OpenedScene scene) {
    for (const std::string& warning : scene.world.warnings) {
        notify(Notice::Kind::Warning, warning);
    }
    const bool isSameModel = mWorld != nullptr && mOpened.model == request.model;
    if (isSameModel) { // perhaps of another size
        scaleSurroundings(scene.world.millimetersPerUnit / mWorld->millimetersPerUnit);
    }
    mStrokeMaterial = -1;
    mWaiting.clear();
    mMover.reset();
    mWorld = std::make_shared<const World>(std::move(scene.world));
    mRendered = std::move(scene.rendered);
    mDocuments = std::move(scene.documents);
    if (mHistoryBytes) {
        setHistoryBytes(*mHistoryBytes);
    }
    mOpened = request;
    activeMaterial = 0;
    adoptFiles(request);
    if (!isSameModel) {
        camera = chooseCamera(*mWorld, {}, aspect);
        fileCamera = camera;
        const std::optional<RigEnvironment> environment = rig.environment;
        rig = {};
        rig.environment = environment;
        for (const Light& light : mWorld->lights) {
            rig.lights.push_back({lightKindName(light.kind), true, light, rig.lights.size()});
        }
        if (rig.lights.empty()) {
            rig.lights = lightPreset("back", camera, mWorld->scatteringSphere);
        }
        view.exposureEv = fittingExposureEv(mWorld->lights, mWorld->scatteringSphere);
        if (view.exposureEv != 0.0f) {
            notify(Notice::Kind::Info,
                   fmt::format("The exposure is {:+.0f} EV, for the lights of the "
                               "model: View changes it",
                               view.exposureEv));
        }
        mFirstLights = mSavedLights = rig.lights;
        selectedLight = 0;
        paint.brush.radiusMm = static_cast<float>(0.08 * mWorld->scatteringSphere.radius);
    }
    adoptMotion(isSameModel);
    ++mWorldRevision;
    touchPicture();
}

std::vector<std::shared_ptr<subedit::MaterialMap>> Session::takeRenderedMaterials() {
    return std::exchange(mRendered, {});
}

void Session::touchMaterial() {
    touchPicture();
}

} // namespace celadon::ui
