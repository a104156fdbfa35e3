#include "ui/viewport_tools.h"

#include "ui/deform_controls.h"
#include "ui/tool_hint.h"
#include "ui/viewport_overlay.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr double kDegreesPerWidth = 220.0; ///< a drag across the viewport's height turns so far
constexpr double kZoomPerNotch = 0.88;
constexpr double kGizmoReachPx = 14.0; ///< at a scale of 1

/// Else the button is the view's.
bool isForTool(const InputEvent& press) {
    return press.button == GLFW_MOUSE_BUTTON_LEFT && (press.modifiers & GLFW_MOD_ALT) == 0;
}

} // namespace

int ViewportTools::lightAt(glm::dvec2 positionPx, const ViewportRect& rect) const {
    for (std::size_t i = 0; i < mSession.rig.lights.size(); ++i) {
        const glm::dvec3 at =
            gizmoPosition(mSession.rig.lights[i].light, mSession.world().scatteringSphere);
        if (projected(mSession.camera, at, rect.aspect()).z > 0.0 &&
            glm::distance(seenAt(mSession.camera, at, rect), positionPx) < kGizmoReachPx * mScale) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

int ViewportTools::controlAt(glm::dvec2 positionPx, const ViewportRect& rect) const {
    int nearest = -1;
    double closest = kGizmoReachPx * mScale;
    for (const DeformControl& control : shownControls(mSession)) {
        const double distance =
            glm::distance(seenAt(mSession.camera, control.shownMm, rect), positionPx);
        if (projected(mSession.camera, control.shownMm, rect.aspect()).z > 0.0 &&
            distance < closest) {
            closest = distance;
            nearest = control.index;
        }
    }
    return nearest;
}

void ViewportTools::dragControlBy(glm::dvec2 deltaPx, const ViewportRect& rect) {
    for (const DeformControl& control : shownControls(mSession)) {
        if (control.index == mControl) { // in the plane that faces the camera
            const double mm = pictureHeightMm(mSession.camera, control.shownMm) / rect.size.y;
            const CameraFrame frame = cameraFrame(mSession.camera);
            Command drag = dragControl(mSession, mControl,
                                       deltaPx.x * mm * frame.right - deltaPx.y * mm * frame.up);
            drag.arguments["continues"] = mHasMoved;
            mHasMoved |= mSession.perform(drag);
            return;
        }
    }
}

void ViewportTools::handle(const InputEvent& event, const ViewportRect& rect, bool overUi) {
    if (!mSession.hasWorld()) {
        mDrag = Drag::None;
        return;
    }
    if (mAdjust) {
        if (event.kind == InputEvent::Kind::Move) {
            adjust(event.positionPx);
        } else if (event.kind == InputEvent::Kind::Press) {
            if (event.button != GLFW_MOUSE_BUTTON_LEFT) {
                cancel();
            }
            mAdjust.reset();
        }
        return;
    }
    switch (event.kind) {
    case InputEvent::Kind::Press:
        if (mDrag == Drag::None && !overUi && rect.contains(event.positionPx)) {
            press(event, rect);
        }
        break;
    case InputEvent::Kind::Release:
        if (event.button == mButton) {
            move(event, rect);
            finishDrag();
        }
        break;
    case InputEvent::Kind::Move:
        move(event, rect);
        break;
    case InputEvent::Kind::Wheel:
        if (!overUi && rect.contains(event.positionPx)) {
            wheel(event, rect);
        }
        break;
    case InputEvent::Kind::Key:
        break;
    }
}

ViewportTools::Drag ViewportTools::viewDrag(const InputEvent& event) {
    const bool alt = (event.modifiers & GLFW_MOD_ALT) != 0;
    const bool shift = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    if (event.button == GLFW_MOUSE_BUTTON_MIDDLE) {
        return shift || alt ? Drag::Pan : Drag::Orbit;
    }
    if (event.button == GLFW_MOUSE_BUTTON_RIGHT) {
        return alt ? Drag::Zoom : Drag::None;
    }
    return Drag::Orbit; // Alt and the left button
}

bool ViewportTools::picks(const InputEvent& event, const ViewportRect& rect, bool overUi) const {
    const bool begins = !overUi && rect.contains(event.positionPx);
    switch (event.kind) {
    case InputEvent::Kind::Press:
        if (!begins || mDrag != Drag::None) {
            return false;
        }
        if (isForTool(event)) {
            return controlAt(event.positionPx, rect) < 0;
        }
        return viewDrag(event) == Drag::Pan || viewDrag(event) == Drag::Zoom;
    case InputEvent::Kind::Wheel:
        return begins;
    case InputEvent::Kind::Move:
    case InputEvent::Kind::Release:
        return mDrag == Drag::Path || mDrag == Drag::Line;
    case InputEvent::Kind::Key:
        break;
    }
    return false;
}

bool ViewportTools::mustWait(const InputEvent& event, const ViewportRect& rect, bool overUi) {
    return mSession.hasWorld() && !mAdjust && picks(event, rect, overUi) && !mPicker.isReady();
}

void ViewportTools::press(const InputEvent& event, const ViewportRect& rect) {
    mButton = event.button;
    mLast = event.positionPx;
    if (isForTool(event)) {
        mControl = controlAt(event.positionPx, rect);
        if (mControl >= 0) {
            mDrag = Drag::Control;
            mHasMoved = false;
            mSession.chooseDeformer(mSession.motion.selected, mControl);
            return;
        }
        mLight = lightAt(event.positionPx, rect);
        // A light before the object is in the way of the brush, unless lights are what is at hand.
        if (mLight >= 0 && (mLightsFirst || !mPicker.pickAtRest(event.positionPx, rect))) {
            mDrag = Drag::Light;
            mHasMoved = false;
            mSession.perform({"light.select", {{"light", mLight}}});
            return;
        }
        pressTool(event, rect);
        return;
    }
    mDrag = viewDrag(event);
    if (mDrag == Drag::Pan || mDrag == Drag::Zoom) {
        mPivot = mPicker.pivot(event.positionPx, rect);
    }
}

void ViewportTools::move(const InputEvent& event, const ViewportRect& rect) {
    const glm::dvec2 delta = event.positionPx - mLast;
    mLast = event.positionPx;
    if (mDrag == Drag::None || delta == glm::dvec2(0.0)) {
        return;
    }
    const double height = rect.size.y;
    switch (mDrag) {
    case Drag::Orbit:
        mSession.perform({"camera.orbit",
                          {{"azimuth", delta.x / height * kDegreesPerWidth},
                           {"elevation", delta.y / height * kDegreesPerWidth}}});
        break;
    case Drag::Pan: {
        const double mm = pictureHeightMm(mSession.camera, mPivot) / height;
        mSession.perform({"camera.pan", {{"right", -delta.x * mm}, {"up", delta.y * mm}}});
        break;
    }
    case Drag::Zoom:
        mSession.perform({"camera.zoom",
                          {{"factor", std::exp((delta.y - delta.x) / height * 2.0)},
                           {"point", toJson(mPivot)}}});
        break;
    case Drag::Light: {
        // In the plane that faces the camera; a directional light turns about the object.
        const auto index = static_cast<std::size_t>(mLight);
        if (index >= mSession.rig.lights.size()) {
            break;
        }
        const glm::dvec3 at =
            gizmoPosition(mSession.rig.lights[index].light, mSession.world().scatteringSphere);
        const double mm = pictureHeightMm(mSession.camera, at) / height;
        const CameraFrame frame = cameraFrame(mSession.camera);
        mHasMoved |= mSession.perform(
            {"light.move",
             {{"light", mLight},
              {"position", toJson(at + delta.x * mm * frame.right - delta.y * mm * frame.up)},
              {"continues", mHasMoved}}});
        break;
    }
    case Drag::Control:
        dragControlBy(delta, rect);
        break;
    case Drag::Path:
        mPath.continueTo(event, rect);
        break;
    case Drag::Line:
        drawLineTo(event.positionPx, rect);
        break;
    case Drag::None:
        break;
    }
}

void ViewportTools::finishDrag() {
    if (mDrag == Drag::Path) {
        mPath.finish();
    }
    mDrag = Drag::None;
    mButton = -1;
}

void ViewportTools::drawLineTo(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<SurfacePoint> hit = mPicker.pickAtRest(positionPx, rect);
    if (hit && hit->positionMm != mLineFrom) {
        mSession.perform(
            {"gradient.line", {{"from", toJson(mLineFrom)}, {"to", toJson(hit->positionMm)}}});
    }
}

bool ViewportTools::addHandleAt(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<SurfacePoint> place = mPicker.pickAtRest(positionPx, rect);
    if (!place) {
        return false;
    }
    constexpr double kHeld = 0.12; // of the model's radius
    const double unit = mSession.world().millimetersPerUnit;
    mSession.perform({"deform.handle.add",
                      {{"at", toJson(place->positionMm / unit)},
                       {"radius", kHeld * mSession.world().scatteringSphere.radius / unit}}});
    return true;
}

void ViewportTools::pressTool(const InputEvent& event, const ViewportRect& rect) {
    if (mSession.motion.isAddingHandles && addHandleAt(event.positionPx, rect)) {
        return;
    }
    if (!mSession.services().isPaintable) {
        mDrag = Drag::Orbit;
        return;
    }
    const ViewMode mode = mSession.view.mode.mode;
    if (mode == ViewMode::Atlas || mode == ViewMode::Irradiance) {
        mSession.notify(Notice::Kind::Info, "This view shows a map, not the surface: choose "
                                            "another in the View tab to paint");
        return;
    }
    const std::optional<SurfacePoint> hit = mPicker.pickAtRest(event.positionPx, rect);
    if (!hit) {
        mDrag = Drag::Orbit; // beside the object the hand turns it
        return;
    }
    if (hit->material >= 0) {
        pressSurface(*hit, event, rect);
    }
}

void ViewportTools::pressSurface(const SurfacePoint& hit, const InputEvent& event,
                                 const ViewportRect& rect) {
    PaintState& paint = mSession.paint;
    if (paint.tool == Tool::Pick) {
        mSession.perform(
            {"profile.pick", {{"material", hit.material}, {"uv", {hit.uv.x, hit.uv.y}}}});
        mSession.perform({"tool.choose", {{"name", "paint"}}});
        return;
    }
    const auto activate = [this](int material) {
        if (material != mSession.activeMaterial) {
            mSession.perform({"material.activate", {{"material", material}}});
        }
    };
    const bool isShifted = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    const nlohmann::json place{{"position", toJson(hit.positionMm)},
                               {"normal", toJson(hit.shadingNormal)}};
    const bool isInverted = (event.modifiers & GLFW_MOD_CONTROL) != 0 || event.isEraser;
    if (paint.tool == Tool::Similar) {
        Command select{"select.similar", place};
        select.arguments["tolerance"] = paint.tolerance;
        select.arguments["mode"] = isShifted ? "add" : "replace";
        activate(hit.material);
        mSession.perform(select);
        return;
    }
    if (paint.tool == Tool::Stamp) {
        Command stamp{"stamp.place", place};
        stamp.arguments["inverted"] = isInverted;
        activate(hit.material);
        mSession.perform(stamp);
        return;
    }
    if (paint.tool == Tool::Scribble) {
        activate(hit.material);
        mDrag = Drag::Path;
        mPath.begin(SurfacePath::Kind::Scribble, event, hit.material, isInverted, rect);
        return;
    }
    if (paint.tool == Tool::Paint && paint.op == PaintOperator::Gradient && isShifted) {
        mDrag = Drag::Line;
        mLineFrom = hit.positionMm;
        return;
    }
    const bool isCopying = paint.tool == Tool::Paint &&
                           (paint.op == PaintOperator::Clone || paint.op == PaintOperator::Pattern);
    if (isCopying && isShifted) {
        mSession.perform({"clone.source", place});
        return;
    }
    if (isCopying) {
        paint.cloneTarget.emplace();
        paint.cloneTarget->positionMm = glm::vec3(hit.positionMm);
        paint.cloneTarget->normal = glm::vec3(hit.shadingNormal);
    }
    mDrag = Drag::Path;
    mPath.begin(SurfacePath::Kind::Stroke, event, hit.material, isInverted, rect);
}

void ViewportTools::cancel() {
    if (mAdjust) {
        mSession.perform({"brush.change",
                          {{"radius", static_cast<double>(mAdjust->brush.radiusMm)},
                           {"flow", static_cast<double>(mAdjust->brush.flow)}}});
        mAdjust.reset();
    }
    if (mDrag == Drag::Path) {
        mSession.cancelStroke();
        mDrag = Drag::None;
    }
    if (mDrag == Drag::Control || mDrag == Drag::Light) {
        const bool isLast = mDrag == Drag::Control || mSession.undoTitle() == "move light";
        if (mHasMoved && isLast) {
            mSession.perform({"edit.undo"});
        }
        mDrag = Drag::None;
    }
    mSession.motion.isAddingHandles = false;
}

void ViewportTools::beginAdjust(Adjust what) {
    if (mDrag == Drag::None && mSession.services().isPaintable) {
        mAdjust = Adjusting{what, mCursor, mSession.paint.brush};
    }
}

void ViewportTools::adjust(glm::dvec2 positionPx) {
    const double moved = positionPx.x - mAdjust->start.x;
    if (mAdjust->what == Adjust::Radius) {
        mSession.perform(
            {"brush.change",
             {{"radius", static_cast<double>(mAdjust->brush.radiusMm) * std::exp(moved / 150.0)}}});
    } else {
        const double flow = static_cast<double>(mAdjust->brush.flow) + moved / 300.0;
        mSession.perform({"brush.change", {{"flow", std::clamp(flow, 0.01, 1.0)}}});
    }
}

void ViewportTools::wheel(const InputEvent& event, const ViewportRect& rect) {
    mSession.perform({"camera.zoom",
                      {{"factor", std::pow(kZoomPerNotch, event.wheel)},
                       {"point", toJson(mPicker.pivot(event.positionPx, rect))}}});
}

std::optional<glm::dvec2> ViewportTools::brushPlace(const ViewportRect& rect) const {
    if (!mSession.services().isPaintable) {
        return std::nullopt;
    }
    if (mPretended) {
        return glm::dvec2(rect.origin) + *mPretended * glm::dvec2(rect.size);
    }
    const glm::dvec2 at = mAdjust ? mAdjust->start : mCursor;
    // While it plays, the surface under a resting cursor is not looked for: that takes a moment.
    const bool isFree = mDrag == Drag::None && !mIsOverUi && !mSession.motion.isPlaying &&
                        !mSession.motion.isAddingHandles;
    return rect.contains(at) && (mDrag == Drag::Path || isFree) ? std::optional(at) : std::nullopt;
}

std::string ViewportTools::hint() const {
    const PaintState& paint = mSession.paint;
    const std::string size = fmt::format("{:.2f} mm", paint.brush.radiusMm);
    const char* const dot = "   \xc2\xb7   ";
    if (mAdjust) {
        return mAdjust->what == Adjust::Radius
                   ? fmt::format("Radius {}{}move sideways, click to keep, Esc to give up", size,
                                 dot)
                   : fmt::format("Flow {:.0f} %{}move sideways, click to keep, Esc to give up",
                                 100.0f * paint.brush.flow, dot);
    }
    switch (mDrag) {
    case Drag::Orbit:
        return "Turning the view";
    case Drag::Pan:
        return "Shifting the view";
    case Drag::Zoom:
        return "Zooming";
    case Drag::Light:
        return "Moving a light: it goes on aiming at the object   \xc2\xb7   Esc to give up";
    case Drag::Control:
        return "Moving a part of the shape, as far from the eye as it is   \xc2\xb7   Esc to give "
               "up";
    case Drag::Line:
        return "Drawing the line of the gradient";
    default:
        break;
    }
    if (mSession.motion.isAddingHandles) {
        return fmt::format("Click: a handle there{}Drag handles{}Esc: enough", dot, dot);
    }
    return toolHint(mSession);
}

void ViewportTools::drawOverlay(ImDrawList& list, const ViewportRect& rect, float scale) {
    mScale = static_cast<double>(scale);
    drawViewportOverlay(list, mSession, mPicker, brushPlace(rect), rect, scale);
}

} // namespace celadon::ui
