#include "ui/state_report.h"

#include "ui/deform_controls.h"
#include "ui/surface_picker.h"

#include <imgui.h>

#include <cmath>

namespace celadon::ui {

namespace {

/// Window pixels; null: none is chosen.
nlohmann::json chosenControlPlace(const Session& session, const ViewportRect& rect) {
    for (const DeformControl& control : shownControls(session)) {
        if (control.index == session.motion.control) {
            const glm::dvec2 at = seenAt(session.camera, control.shownMm, rect);
            return {std::round(at.x), std::round(at.y)};
        }
    }
    return nullptr;
}

} // namespace

nlohmann::json reportState(const StateSources& sources) {
    const Session& session = sources.session;
    const Viewport& viewport = sources.viewport;
    const ViewportRect& rect = viewport.rect();
    const subedit::Document* const document = session.activeDocument();
    return {{"model", session.opened().model},
            {"open", session.hasWorld()},
            {"opening", sources.isOpening},
            {"preparing", viewport.isPreparing()},
            {"settled", sources.isSettled},
            {"rung", viewport.shownRung()},
            {"revision", session.pictureRevision()},
            {"viewport", {rect.origin.x, rect.origin.y, rect.size.x, rect.size.y}},
            {"replayed", sources.script.executed()},
            {"pictures", viewport.pictureCount()},
            {"pictureMs", std::round(viewport.shown().timeMs)},
            {"modified", session.isModified()},
            {"asking", sources.files.isAsking()},
            {"problem", sources.files.problem()},
            {"typing", ImGui::GetIO().WantTextInput},
            {"undo", session.undoTitle().has_value()},
            {"playing", session.motion.isPlaying},
            {"seconds", session.motion.now.seconds},
            {"deformers", session.motion.now.deformers.size()},
            {"control", chosenControlPlace(session, rect)},
            {"strokes", document != nullptr ? document->commandCount() : 0},
            {"notices", session.notices.empty() ? "" : session.notices.back().text}};
}

} // namespace celadon::ui
