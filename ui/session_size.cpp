// How large the model is.
#include "subedit/document/edit_progress.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <utility>

namespace celadon::ui {

namespace {

void scaleCamera(Camera& camera, double factor) {
    camera.eye *= factor;
    camera.at *= factor;
    if (camera.orthographicHeight) {
        *camera.orthographicHeight *= factor;
    }
}

} // namespace

void Session::resize(double diameterMm) {
    if (mWorld == nullptr) {
        throw UsageError("size", "no model is open", "open one first");
    }
    if (isStrokeOpen()) {
        throw UsageError("size", "a stroke is being painted", "end it first");
    }
    const double factor = diameterMm / (2.0 * mWorld->scatteringSphere.radius);
    World next = resized(*mWorld, factor);
    for (int i = 0; i < materialCount(); ++i) {
        if (document(i) != nullptr) { // the world's own follow on the picture's thread
            next.materials[static_cast<std::size_t>(i)] =
                std::make_shared<subedit::MaterialMap>(document(i)->material());
        }
    }
    OpenedScene scene;
    subedit::doTelling(progressOf("change of size"),
                       [&] { scene = prepareScene(std::move(next), mServices.isPaintable); });
    OpenRequest request = mOpened;
    request.diameterMm = diameterMm;
    const std::vector<std::filesystem::path> files = mFiles;
    std::vector<std::uint64_t> saved;
    for (int i = 0; i < materialCount(); ++i) {
        saved.push_back(isModified(i) ? kSavedNever : 0);
    }
    const int active = activeMaterial;
    const bool hadSteps = undoTitle().has_value();
    // What stands about the model goes along, so that it looks as before.
    scaleCamera(camera, factor);
    if (fileCamera) {
        scaleCamera(*fileCamera, factor);
    }
    for (RigLight& item : rig.lights) {
        item.light.position *= factor;
        if (item.light.kind != Light::Kind::Directional) {
            item.light.color *= factor * factor; // W/sr
        }
    }
    paint.brush.radiusMm *= static_cast<float>(factor);
    paint.gradientFromMm *= static_cast<float>(factor);
    paint.gradientToMm *= static_cast<float>(factor);
    paint.cloneSource.reset();
    paint.cloneTarget.reset();
    paint.propagation.scribbles.clear();
    adopt(request, std::move(scene));
    mFiles = files;
    mSaved = saved;
    activeMaterial = active;
    if (hadSteps) {
        notify(Notice::Kind::Info,
               "What was done before the change of size can no longer be undone");
    }
}

} // namespace celadon::ui
