#include "ui/session.h"

#include "renderer/scene/camera.h"
#include "subedit/errors.h"

#include <algorithm>

namespace celadon::ui {

Session::Session(SessionServices services) : mServices(std::move(services)) {
    addCameraCommands(*this);
    addLightCommands(*this);
    addViewCommands(*this);
    addFileCommands(*this);
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
    constexpr std::size_t kMostNotices = 6;
    const auto same = std::find_if(notices.begin(), notices.end(),
                                   [&](const Notice& notice) { return notice.text == text; });
    if (same != notices.end()) {
        notices.erase(same);
    }
    notices.push_back({kind, text});
    if (notices.size() > kMostNotices) {
        notices.erase(notices.begin());
    }
}

void Session::adopt(const OpenRequest& request, World world) {
    for (const std::string& warning : world.warnings) {
        notify(Notice::Kind::Warning, warning);
    }
    mWorld = std::make_shared<const World>(std::move(world));
    mOpened = request;
    camera = chooseCamera(*mWorld, {}, aspect);
    fileCamera = camera;
    rig = {};
    for (const Light& light : mWorld->lights) {
        rig.lights.push_back({lightKindName(light.kind), true, light});
    }
    if (rig.lights.empty()) {
        rig.lights = lightPreset("back", camera, mWorld->scatteringSphere);
    }
    selectedLight = 0;
    ++mWorldRevision;
    touchPicture();
}

} // namespace celadon::ui
