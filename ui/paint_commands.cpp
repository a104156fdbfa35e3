// Commands that change materials, and strokes as they happen. Whatever changes a material is in the
// end one command, "paint.edit", which holds everything that it depends on: a replay gives the same
// bytes whatever the hand held.
#include "subedit/document/stroke_file.h"
#include "subedit/errors.h"
#include "ui/session.h"

#include <fmt/format.h>

namespace celadon::ui {

namespace {

constexpr const char* kNothingSelected =
    "Nothing is selected, so nothing changes: Select all, in the Edit menu, ends that";
constexpr const char* kOutsideOfSelection =
    "That lies outside of what is selected, so nothing changes: Select all, in the Edit menu, ends "
    "that";

void refuseDuringStroke(const Session& session) {
    if (session.isStrokeOpen()) {
        throw UsageError("the stroke", "has not ended", "finish it, or Escape gives it up");
    }
}

subedit::Document& documentOf(Session& session, int material) {
    subedit::Document* const document = session.document(material);
    if (document == nullptr) {
        throw UsageError("painting", "there is no material to paint on", "open a model first");
    }
    refuseDuringStroke(session);
    return *document;
}

Command editCommand(int material, const subedit::EditCommand& edit) {
    return {"paint.edit",
            {{"material", material}, {"edit", nlohmann::json::parse(subedit::commandText(edit))}}};
}

/// After an edit by hand: what follows from it, what there is to say, and its record.
void finishEdit(Session& session, int material, const subedit::EditCommand& edit,
                const subedit::EditReport& report) {
    session.dropUndone();
    session.dispatcher().announce(editCommand(material, edit));
    session.tell(report, std::holds_alternative<subedit::SelectCommand>(edit));
    session.touchMaterial();
}

subedit::SelectMode parseSelectMode(const std::string& word) {
    for (const auto& [name, mode] : {std::pair{"replace", subedit::SelectMode::Replace},
                                     std::pair{"add", subedit::SelectMode::Add},
                                     std::pair{"subtract", subedit::SelectMode::Subtract},
                                     std::pair{"intersect", subedit::SelectMode::Intersect}}) {
        if (word == name) {
            return mode;
        }
    }
    throw UsageError(fmt::format("selection '{}'", word), "there is no such way to combine",
                     "choose replace, add, subtract or intersect");
}

/// Whether all or nothing is to be selected, and is.
bool isSelectedAlready(const Session& session, const std::string& what) {
    if (session.activeDocument() == nullptr) {
        return false;
    }
    const subedit::WeightMask& selection = session.activeDocument()->selection();
    return (what == "none" && selection.isZero()) ||
           (what == "all" &&
            selection == subedit::WeightMask::full(selection.width(), selection.height()));
}

subedit::SelectionStep selectionStep(const Arguments& a) {
    const std::string what = a.text("what");
    const auto distance = [&a] { return static_cast<float>(a.numberWithin("mm", 1e-3, 1e4)); };
    if (what == "all") {
        return subedit::SelectAll{};
    }
    if (what == "none") {
        return subedit::SelectNone{};
    }
    if (what == "invert") {
        return subedit::InvertSelection{};
    }
    if (what == "grow") {
        return subedit::GrowSelection{distance()};
    }
    if (what == "shrink") {
        return subedit::ShrinkSelection{distance()};
    }
    if (what == "feather") {
        return subedit::FeatherSelection{distance()};
    }
    throw UsageError(fmt::format("selection '{}'", what), "there is no such step",
                     "choose all, none, invert, grow, shrink or feather");
}

/// As it was carried out: what took back a setting says so.
Command undoCommand(const char* name, Session::Undone undone) {
    Command command{name, nlohmann::json::object()};
    if (undone == Session::Undone::Setting) {
        command.arguments["setting"] = true;
    }
    return command;
}

} // namespace

subedit::EditProgress Session::progressOf(const std::string& title) const {
    if (!onProgress) {
        return {};
    }
    return [this, title](float done) { onProgress(title, done); };
}

void Session::edit(const subedit::EditCommand& command) {
    subedit::Document& target = documentOf(*this, activeMaterial);
    const subedit::EditReport report = target.execute(command, progressOf(editTitle(command)));
    finishEdit(*this, activeMaterial, command, report);
}

void Session::tell(const subedit::EditReport& report, bool isSelection) {
    if (isSelection) { // what was said of the one before
        std::erase_if(notices, [](const Notice& notice) {
            return notice.text == kNothingSelected || notice.text == kOutsideOfSelection;
        });
    }
    if (report.grownRadiusMm) {
        notify(Notice::Kind::Info, fmt::format("Profiles now reach to {:.3g} mm (r_s): the edit "
                                               "needed more range",
                                               *report.grownRadiusMm));
    }
    if (report.texels == 0 && !isSelection && activeDocument() != nullptr) {
        const subedit::WeightMask& selection = activeDocument()->selection();
        if (selection.isZero()) {
            notify(Notice::Kind::Warning, kNothingSelected);
        } else if (selection != subedit::WeightMask::full(selection.width(), selection.height())) {
            notify(Notice::Kind::Warning, kOutsideOfSelection);
        }
    }
    if (report.texels > 0 && 4 * report.rangeClamped > report.texels) {
        notify(Notice::Kind::Warning, "The range is at its limit: most of the edit was clamped");
    }
}

subedit::Mirror Session::mirror() const {
    return {{paint.mirror[0], paint.mirror[1], paint.mirror[2]},
            glm::vec3(mWorld->scatteringSphere.center)};
}

void Session::beginStroke(int material, const subedit::StrokePoint& point, bool inverted) {
    subedit::Document* const target = document(material);
    if (target == nullptr || isStrokeOpen()) {
        return;
    }
    const bool selects = paint.tool == Tool::Select; // whatever the operator lacks
    Stroke stroke{{selects ? subedit::EditOperator{} : makeOperator(paint, inverted),
                   paint.brush,
                   mirror(),
                   {point}},
                  inverted,
                  selects};
    stroke.isLive = !stroke.selects && subedit::isLocal(stroke.command.op);
    if (stroke.isLive && hasWaiting()) { // while it lasts nothing else may change the material
        performWaiting();
        beginStroke(material, point, inverted);
        return;
    }
    if (stroke.isLive) {
        target->beginStroke(stroke.command);
    }
    mStroke = std::move(stroke);
    mStrokeMaterial = material;
    activeMaterial = material;
    touchMaterial();
}

void Session::addStrokePoint(const subedit::StrokePoint& point) {
    if (!isStrokeOpen()) {
        return;
    }
    mStroke.command.path.push_back(point);
    if (mStroke.isLive) {
        document(mStrokeMaterial)->addStrokePoint(point);
        touchMaterial();
    }
}

void Session::endStroke() {
    if (!isStrokeOpen()) {
        return;
    }
    const int material = std::exchange(mStrokeMaterial, -1);
    if (mStroke.isLive) {
        finishStroke(material, mStroke);
    } else {
        performLong([this, material, stroke = mStroke] { finishStroke(material, stroke); });
    }
}

void Session::finishStroke(int material, const Stroke& stroke) {
    if (document(material) == nullptr) {
        return;
    }
    subedit::Document& target = *document(material);
    subedit::EditCommand edit = stroke.command;
    if (stroke.selects) {
        // While everything is selected, a first stroke chooses.
        const subedit::WeightMask& now = target.selection();
        const bool isAll = now == subedit::WeightMask::full(now.width(), now.height());
        const subedit::SelectMode adding = isAll ? subedit::SelectMode::Replace : paint.selectMode;
        edit = subedit::SelectCommand{
            subedit::SelectStroke{stroke.command.brush, stroke.command.mirror, stroke.command.path},
            stroke.isInverted ? subedit::SelectMode::Subtract : adding};
    }
    const subedit::EditReport report =
        stroke.isLive ? target.endStroke() : target.execute(edit, progressOf(editTitle(edit)));
    finishEdit(*this, material, edit, report);
}

void Session::cancelStroke() {
    if (isStrokeOpen()) {
        if (mStroke.isLive) {
            document(mStrokeMaterial)->cancelStroke();
        }
        mStrokeMaterial = -1;
        touchMaterial();
    }
}

void addPaintCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("paint.edit", "Any change of a material, as a stroke file has it",
                 [&session](const Arguments& a) {
                     const int material = a.integerWithin("material", 0, 64);
                     const subedit::EditCommand edit =
                         subedit::parseCommand("paint.edit", a.value("edit").dump());
                     subedit::Document& document = documentOf(session, material);
                     session.activeMaterial = material; // as by the hand that did it
                     document.execute(edit, session.progressOf(editTitle(edit)));
                     session.dropUndone();
                     session.touchMaterial();
                 });
    // Both may take long, so they are recorded when they are done.
    commands.addLong(
        "edit.undo", "Takes back the last change: of a material, deformers, lights or a profile",
        [&session](const Arguments&) {
            refuseDuringStroke(session);
            if (const auto undone = session.undo(); undone != Session::Undone::Nothing) {
                session.dispatcher().announce(undoCommand("edit.undo", undone));
            } else if (session.isAnyForgotten()) {
                throw UsageError("undo", "older steps are forgotten: the preferences say how "
                                         "much memory undoing may take");
            }
        });
    commands.addLong("edit.redo", "Repeats what was taken back", [&session](const Arguments&) {
        refuseDuringStroke(session);
        if (const auto redone = session.redo(); redone != Session::Undone::Nothing) {
            session.dispatcher().announce(undoCommand("edit.redo", redone));
        }
    });
    commands.add("material.activate", "Chooses which material is worked on",
                 [&session](const Arguments& a) {
                     session.activeMaterial =
                         a.integerWithin("material", 0, std::max(0, session.materialCount() - 1));
                 });
    // These depend on what the hand holds: they are recorded as the edit that they come to.
    commands.addLong("edit.fill", "Applies the operator to everything that is selected",
                     [&session](const Arguments& a) {
                         session.edit(subedit::ApplyCommand{
                             makeOperator(session.paint, a.flag("inverted", false))});
                     });
    commands.addLong(
        "select.change", "all, none, invert; grow, shrink, feather by mm along the surface",
        [&session](const Arguments& a) {
            if (!isSelectedAlready(session, a.text("what"))) { // no step, and redoing stays
                session.edit(subedit::SelectCommand{selectionStep(a)});
            }
        });
    commands.addLong(
        "select.similar", "Texels whose profile is like that at a point: position and normal",
        [&session](const Arguments& a) {
            subedit::SelectSimilar similar;
            similar.point.positionMm = glm::vec3(a.vector3("position"));
            similar.point.normal = glm::vec3(a.vector3("normal"));
            similar.tolerance = static_cast<float>(a.numberWithin("tolerance", 1e-3, 1.0));
            session.edit(
                subedit::SelectCommand{similar, parseSelectMode(a.text("mode", "replace"))});
        });
    commands.add(
        "clone.source", "Where clone and pattern strokes take from: position, normal",
        [&session](const Arguments& a) {
            subedit::StrokePoint point;
            point.positionMm = glm::vec3(a.vector3("position"));
            point.normal = glm::vec3(a.vector3("normal"));
            session.paint.cloneSource = point;
        },
        true);
}

} // namespace celadon::ui
