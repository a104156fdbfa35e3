// How large the model is.
#include "renderer/scene/motion.h"
#include "subedit/document/edit_progress.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace celadon::ui {

namespace {

constexpr double kSameSize = 1e-6; ///< relative: as far as millimeters in floats go

void scaleCamera(Camera& camera, double factor) {
    camera.eye *= factor;
    camera.at *= factor;
    if (camera.orthographicHeight) {
        *camera.orthographicHeight *= factor;
    }
}

void scaleNumbers(KeyedNumbers& numbers, double factor) {
    for (double& value : numbers.values) {
        value *= factor;
    }
}

/// What deformers have in mm; the rest is in units of the model.
void scaleMillimeters(DeformerStack& stack, double factor) {
    for (AnimatedDeformer& deformer : stack) {
        const bool isWave = deformer.kind == Deformer::Kind::Wave;
        if (isWave || deformer.kind == Deformer::Kind::Inflate) {
            scaleNumbers(deformer.amount, factor);
        }
        if (isWave) {
            scaleNumbers(deformer.wavelengthMm, factor);
        }
    }
}

} // namespace

void Session::scaleSurroundings(double factor) {
    if (std::abs(factor - 1.0) < kSameSize) {
        return;
    }
    scaleCamera(camera, factor);
    for (std::optional<Camera>* const other : {&fileCamera, &mFollowedCamera}) {
        if (*other) {
            scaleCamera(**other, factor);
        }
    }
    for (std::vector<RigLight>* const lights : {&rig.lights, &mFirstLights, &mSavedLights}) {
        for (RigLight& item : *lights) {
            item.light.position *= factor;
            if (item.light.kind != Light::Kind::Directional) {
                item.light.color *= factor * factor; // W/sr
            }
        }
    }
    scaleMillimeters(motion.now.deformers, factor);
    scaleMillimeters(mSavedDeformers, factor);
    const auto f = static_cast<float>(factor);
    paint.brush.radiusMm = std::clamp(paint.brush.radiusMm * f, 1e-3f, 1e4f);
    paint.gradientFromMm *= f;
    paint.gradientToMm *= f;
    paint.cloneSource.reset();
    paint.cloneTarget.reset();
    paint.propagation.scribbles.clear();
}

void Session::resize(double diameterMm) {
    if (mWorld == nullptr) {
        throw UsageError("size", "no model is open", "open one first");
    }
    if (isStrokeOpen()) {
        throw UsageError("size", "a stroke is being painted", "end it first");
    }
    const double factor = diameterMm / (2.0 * mWorld->scatteringSphere.radius);
    if (std::abs(factor - 1.0) < kSameSize) {
        return;
    }
    if (beforeResizing) {
        beforeResizing();
    }
    World next = resized(*mWorld, factor);
    for (int i = 0; i < materialCount(); ++i) {
        if (document(i) != nullptr) { // the world's own follow on the picture's thread
            next.materials[static_cast<std::size_t>(i)] =
                std::make_shared<subedit::MaterialMap>(document(i)->material());
        }
    }
    DeformerStack stack = motion.now.deformers;
    scaleMillimeters(stack, factor);
    OpenedScene scene;
    subedit::doTelling(progressOf("change of size"), [&] {
        Motion(next).setDeformers(std::move(stack)); // handles are prepared before anything changes
        scene = prepareScene(std::move(next), mServices.isPaintable);
    });
    OpenRequest request = mOpened;
    request.diameterMm = diameterMm;
    const std::vector<std::filesystem::path> files = mFiles;
    std::vector<std::uint64_t> saved;
    for (int i = 0; i < materialCount(); ++i) {
        saved.push_back(isModified(i) ? kSavedNever : 0);
        subedit::Document* const resizedDocument =
            scene.documents[static_cast<std::size_t>(i)].get();
        if (document(i) != nullptr && resizedDocument != nullptr) {
            resizedDocument->takeSelection(*document(i));
        }
    }
    const int active = activeMaterial;
    const bool hadSteps = undoTitle().has_value();
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
