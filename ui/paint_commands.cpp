// Commands that change materials, and strokes as they happen.
#include "subedit/errors.h"
#include "ui/session.h"

#include <fmt/format.h>

namespace celadon::ui {

namespace {

subedit::Document& documentOf(Session& session) {
    subedit::Document* const document = session.activeDocument();
    if (document == nullptr) {
        throw UsageError("painting", "there is no material to paint on", "open a model first");
    }
    if (session.isStrokeOpen()) {
        throw UsageError("painting", "a stroke is under way");
    }
    return *document;
}

} // namespace

void Session::beginStroke(int material, const subedit::StrokePoint& point, bool inverted) {
    subedit::Document* const target = document(material);
    if (target == nullptr || isStrokeOpen()) {
        return;
    }
    activeMaterial = material;
    subedit::StrokeCommand stroke;
    stroke.op = makeOperator(paint, inverted);
    stroke.brush = paint.brush;
    stroke.mirror.axes = {paint.mirror[0], paint.mirror[1], paint.mirror[2]};
    stroke.mirror.centerMm = glm::vec3(mWorld->scatteringSphere.center);
    stroke.path = {point};
    target->beginStroke(std::move(stroke));
    mStrokeMaterial = material;
    touchMaterial();
}

void Session::addStrokePoint(const subedit::StrokePoint& point) {
    if (isStrokeOpen()) {
        document(mStrokeMaterial)->addStrokePoint(point);
        touchMaterial();
    }
}

void Session::endStroke() {
    if (!isStrokeOpen()) {
        return;
    }
    subedit::Document& target = *document(mStrokeMaterial);
    mStrokeMaterial = -1;
    target.endStroke();
    touchMaterial();
}

void Session::cancelStroke() {
    if (isStrokeOpen()) {
        document(mStrokeMaterial)->cancelStroke();
        mStrokeMaterial = -1;
        touchMaterial();
    }
}

void addPaintCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("edit.undo", "Takes back the last change of the material",
                 [&session](const Arguments&) {
                     if (documentOf(session).undo()) {
                         session.touchMaterial();
                     }
                 });
    commands.add("edit.redo", "Repeats what was taken back", [&session](const Arguments&) {
        if (documentOf(session).redo()) {
            session.touchMaterial();
        }
    });
    commands.add("edit.fill", "Applies the operator to everything that is selected",
                 [&session](const Arguments& a) {
                     documentOf(session).execute(subedit::ApplyCommand{
                         makeOperator(session.paint, a.flag("inverted", false))});
                     session.touchMaterial();
                 });
    commands.add("material.activate", "Chooses which material is worked on",
                 [&session](const Arguments& a) {
                     session.activeMaterial =
                         a.integerWithin("material", 0, std::max(0, session.materialCount() - 1));
                 });
}

} // namespace celadon::ui
