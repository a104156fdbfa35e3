#include "ui/viewport_tools.h"

#include "subedit/errors.h"
#include "ui/deform_controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr double kDegreesPerWidth = 220.0; ///< a drag across the viewport's height turns so far
constexpr double kZoomPerNotch = 0.88;
constexpr double kGizmoReachPx = 14.0;

glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point, const ViewportRect& rect) {
    const glm::dvec3 place = projected(camera, point, rect.aspect());
    return glm::dvec2(rect.origin) + glm::dvec2(place) * glm::dvec2(rect.size);
}

} // namespace

const RayScene* ViewportTools::rays() {
    if (!mSession.hasWorld()) {
        return nullptr;
    }
    if (mRayWorld != mSession.shownWorld()) {
        mRays.reset();
        mRayWorld = mSession.shownWorld();
        mRays = std::make_unique<RayScene>(*mRayWorld);
    }
    return mRays.get();
}

std::optional<RayScene::Hit> ViewportTools::hitAt(glm::dvec2 positionPx,
                                                  const ViewportRect& rect) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return std::nullopt;
    }
    const Ray ray = rayThrough(mSession.camera, rect.place(positionPx), rect.aspect());
    return scene->nearest(ray.origin, ray.direction);
}

std::optional<SurfacePoint> ViewportTools::pick(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<RayScene::Hit> hit = hitAt(positionPx, rect);
    return hit ? std::optional(surfacePoint(*mRayWorld, hit->place)) : std::nullopt;
}

std::optional<SurfacePoint> ViewportTools::pickAtRest(glm::dvec2 positionPx,
                                                      const ViewportRect& rect) {
    const std::optional<RayScene::Hit> hit = hitAt(positionPx, rect);
    return hit ? std::optional(surfacePoint(mSession.world(), hit->place)) : std::nullopt;
}

glm::dvec3 ViewportTools::pivot(glm::dvec2 positionPx, const ViewportRect& rect) {
    if (const std::optional<SurfacePoint> hit = pick(positionPx, rect)) {
        return hit->positionMm;
    }
    // Beside the object: the point of the ray that is as deep as the target.
    const Camera& camera = mSession.camera;
    const Ray ray = rayThrough(camera, rect.place(positionPx), rect.aspect());
    const glm::dvec3 forward = cameraFrame(camera).forward;
    const double along =
        glm::dot(camera.at - ray.origin, forward) / glm::dot(ray.direction, forward);
    return ray.origin + along * ray.direction;
}

int ViewportTools::lightAt(glm::dvec2 positionPx, const ViewportRect& rect) const {
    for (std::size_t i = 0; i < mSession.rig.lights.size(); ++i) {
        const glm::dvec3 at =
            gizmoPosition(mSession.rig.lights[i].light, mSession.world().scatteringSphere);
        if (projected(mSession.camera, at, rect.aspect()).z > 0.0 &&
            glm::distance(seenAt(mSession.camera, at, rect), positionPx) < kGizmoReachPx) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

int ViewportTools::controlAt(glm::dvec2 positionPx, const ViewportRect& rect) const {
    int nearest = -1;
    double closest = kGizmoReachPx;
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
            if (mDrag == Drag::Paint) {
                mSession.endStroke();
            }
            mDrag = Drag::None;
            mButton = -1;
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

void ViewportTools::press(const InputEvent& event, const ViewportRect& rect) {
    const bool alt = (event.modifiers & GLFW_MOD_ALT) != 0;
    const bool shift = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    mButton = event.button;
    mLast = event.positionPx;
    if (event.button == GLFW_MOUSE_BUTTON_LEFT && !alt) {
        mControl = controlAt(event.positionPx, rect);
        if (mControl >= 0) {
            mDrag = Drag::Control;
            mSession.perform({"deform.select",
                              {{"deformer", mSession.motion.selected}, {"control", mControl}}});
            return;
        }
        mLight = lightAt(event.positionPx, rect);
        if (mLight >= 0) {
            mDrag = Drag::Light;
            mSession.perform({"light.select", {{"light", mLight}}});
            return;
        }
        pressTool(event, rect);
        return;
    }
    if (event.button == GLFW_MOUSE_BUTTON_MIDDLE) {
        mDrag = shift || alt ? Drag::Pan : Drag::Orbit;
    } else if (event.button == GLFW_MOUSE_BUTTON_RIGHT) {
        mDrag = alt ? Drag::Zoom : Drag::None;
    } else {
        mDrag = Drag::Orbit; // Alt and the left button
    }
    mPivot = mDrag == Drag::Orbit ? glm::dvec3(0.0) : pivot(event.positionPx, rect);
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
        mSession.perform(
            {"light.move",
             {{"light", mLight},
              {"position", toJson(at + delta.x * mm * frame.right - delta.y * mm * frame.up)}}});
        break;
    }
    case Drag::Control:
        for (const DeformControl& control : shownControls(mSession)) {
            if (control.index == mControl) { // in the plane that faces the camera
                const double mm = pictureHeightMm(mSession.camera, control.shownMm) / height;
                const CameraFrame frame = cameraFrame(mSession.camera);
                mSession.perform(
                    dragControl(mSession, mControl,
                                delta.x * mm * frame.right - delta.y * mm * frame.up));
            }
        }
        break;
    case Drag::Paint:
        paintTo(event.positionPx, rect);
        break;
    case Drag::None:
        break;
    }
}

void ViewportTools::pressTool(const InputEvent& event, const ViewportRect& rect) {
    if (mSession.motion.isAddingHandles) {
        if (const std::optional<SurfacePoint> place = pickAtRest(event.positionPx, rect)) {
            const double unit = mSession.world().millimetersPerUnit;
            constexpr double kHeld = 0.12; // of the model's radius
            const double radius = kHeld * mSession.world().scatteringSphere.radius;
            mSession.perform(
                {"deform.handle.add",
                 {{"at", toJson(place->positionMm / unit)}, {"radius", radius / unit}}});
            return;
        }
    }
    if (!mSession.services().isPaintable) {
        mDrag = Drag::Orbit;
        return;
    }
    const std::optional<SurfacePoint> hit = pickAtRest(event.positionPx, rect);
    if (!hit) {
        mDrag = Drag::Orbit; // beside the object the hand turns it
        return;
    }
    if (hit->material < 0) {
        return;
    }
    if (mSession.paint.tool == Tool::Pick) {
        mSession.perform(
            {"profile.pick", {{"material", hit->material}, {"uv", {hit->uv.x, hit->uv.y}}}});
        mSession.perform({"tool.choose", {{"name", "paint"}}});
        return;
    }
    const bool isShifted = (event.modifiers & GLFW_MOD_SHIFT) != 0;
    const nlohmann::json place{{"position", toJson(hit->positionMm)},
                               {"normal", toJson(hit->shadingNormal)}};
    PaintState& paint = mSession.paint;
    if (paint.tool == Tool::Similar) {
        Command select{"select.similar", place};
        select.arguments["tolerance"] = paint.tolerance;
        select.arguments["mode"] = isShifted ? "add" : "replace";
        mSession.activeMaterial = hit->material;
        mSession.perform(select);
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
        paint.cloneTarget->positionMm = glm::vec3(hit->positionMm);
        paint.cloneTarget->normal = glm::vec3(hit->shadingNormal);
    }
    mInverted = (event.modifiers & GLFW_MOD_CONTROL) != 0;
    mDrag = Drag::Paint;
    mPaintedPx = event.positionPx;
    mLastPoint.reset();
    paintPoint(event.positionPx, rect);
}

bool ViewportTools::paintPoint(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<SurfacePoint> hit = pickAtRest(positionPx, rect);
    if (!hit || hit->material < 0 ||
        (mSession.isStrokeOpen() && hit->material != mSession.activeMaterial)) {
        mLastPoint.reset();
        return false;
    }
    subedit::StrokePoint point;
    point.positionMm = glm::vec3(hit->positionMm);
    point.normal = glm::vec3(hit->shadingNormal);
    // After a gap, or where the surface jumps, the path begins anew: nothing between is painted.
    constexpr double kJump = 2.5; // radii
    const bool goesOn = mSession.isStrokeOpen() && mLastPoint &&
                        glm::distance(*mLastPoint, hit->positionMm) <
                            kJump * static_cast<double>(mSession.paint.brush.radiusMm);
    if (!goesOn) {
        mSession.endStroke();
        try {
            mSession.beginStroke(hit->material, point, mInverted);
        } catch (const Error& error) {
            mSession.notify(Notice::Kind::Error, error.what());
            return false;
        }
    } else {
        mSession.addStrokePoint(point);
    }
    mLastPoint = hit->positionMm;
    return true;
}

void ViewportTools::paintTo(glm::dvec2 positionPx, const ViewportRect& rect) {
    // A fast hand: points between, so that the path follows the surface.
    constexpr int kMostPoints = 128;
    const glm::dvec2 from = mPaintedPx;
    double stepPx = 8.0;
    if (mLastPoint) {
        const double mmPerPx = pictureHeightMm(mSession.camera, *mLastPoint) / rect.size.y;
        stepPx = std::max(1.0, 0.5 * static_cast<double>(mSession.paint.brush.radiusMm) / mmPerPx);
    }
    const int steps = std::clamp(
        static_cast<int>(std::ceil(glm::distance(from, positionPx) / stepPx)), 1, kMostPoints);
    for (int i = 1; i <= steps; ++i) {
        paintPoint(glm::mix(from, positionPx, static_cast<double>(i) / steps), rect);
    }
    mPaintedPx = positionPx;
}

void ViewportTools::cancel() {
    if (mAdjust) {
        mSession.paint.brush = mAdjust->brush;
        mAdjust.reset();
    }
    if (mDrag == Drag::Paint) {
        mSession.cancelStroke();
        mDrag = Drag::None;
    }
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

void ViewportTools::drawBrush(ImDrawList& list, const ViewportRect& rect, float scale) {
    if (!mSession.services().isPaintable || mSession.paint.tool == Tool::Pick ||
        mSession.paint.tool == Tool::Similar) {
        return;
    }
    const glm::dvec2 at = mAdjust ? mAdjust->start : mCursor;
    if ((mIsOverUi && mDrag != Drag::Paint) || !rect.contains(at) ||
        (mDrag != Drag::None && mDrag != Drag::Paint)) {
        return;
    }
    const std::optional<SurfacePoint> hit = pick(at, rect);
    if (!hit || hit->material < 0) {
        return;
    }
    const glm::dvec3 n = hit->shadingNormal;
    const glm::dvec3 side = glm::normalize(
        glm::cross(std::abs(n.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0), n));
    const glm::dvec3 other = glm::cross(n, side);
    const auto ring = [&](double radiusMm, ImU32 color, float width) {
        // Each point is laid on the surface where that is near the tangent plane.
        constexpr int kPoints = 48;
        ImVec2 points[kPoints];
        for (int i = 0; i < kPoints; ++i) {
            const double angle = 2.0 * 3.14159265358979 * i / kPoints;
            glm::dvec3 p =
                hit->positionMm + radiusMm * (std::cos(angle) * side + std::sin(angle) * other);
            const RayScene* const scene = rays();
            const double reach = 0.35 * radiusMm;
            const auto down = scene->nearest(p + reach * n, -n);
            if (down && down->distanceMm < 2.0 * reach) {
                p += (reach - down->distanceMm) * n;
            }
            const glm::dvec2 seen = seenAt(mSession.camera, p, rect);
            points[i] = {static_cast<float>(seen.x), static_cast<float>(seen.y)};
        }
        list.AddPolyline(points, kPoints, color, ImDrawFlags_Closed, width);
    };
    const subedit::Brush& brush = mSession.paint.brush;
    const double radius = static_cast<double>(brush.radiusMm);
    ring(radius, IM_COL32(0, 0, 0, 120), 3.0f * scale);
    ring(radius, IM_COL32(255, 255, 255, 220), 1.4f * scale);
    if (brush.hardness > 0.02f && brush.hardness < 0.98f) {
        ring(radius * static_cast<double>(brush.hardness), IM_COL32(255, 255, 255, 70),
             1.0f * scale);
    }
}

void ViewportTools::wheel(const InputEvent& event, const ViewportRect& rect) {
    mSession.perform({"camera.zoom",
                      {{"factor", std::pow(kZoomPerNotch, event.wheel)},
                       {"point", toJson(pivot(event.positionPx, rect))}}});
}

void ViewportTools::drawControls(ImDrawList& list, const ViewportRect& rect, float scale) const {
    const std::vector<DeformControl> controls = shownControls(mSession);
    std::vector<ImVec2> seen;
    std::vector<bool> isInFront;
    for (const DeformControl& control : controls) {
        const glm::dvec2 p = seenAt(mSession.camera, control.shownMm, rect);
        seen.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
        isInFront.push_back(projected(mSession.camera, control.shownMm, rect.aspect()).z > 0.0);
    }
    for (const auto& [a, b] : controlLines(mSession)) {
        const auto i = static_cast<std::size_t>(a);
        const auto j = static_cast<std::size_t>(b);
        if (isInFront[i] && isInFront[j]) {
            list.AddLine(seen[i], seen[j], IM_COL32(255, 255, 255, 70), 1.0f * scale);
        }
    }
    for (std::size_t i = 0; i < controls.size(); ++i) {
        if (isInFront[i] && rect.contains({seen[i].x, seen[i].y})) {
            const bool isChosen = controls[i].index == mSession.motion.control;
            list.AddCircleFilled(seen[i], (isChosen ? 6.0f : 4.5f) * scale,
                                 isChosen ? IM_COL32(140, 220, 190, 255)
                                          : IM_COL32(235, 235, 235, 220), 16);
            list.AddCircle(seen[i], (isChosen ? 6.0f : 4.5f) * scale, IM_COL32(0, 0, 0, 160), 16,
                           1.2f * scale);
        }
    }
}

void ViewportTools::drawOverlay(ImDrawList& list, const ViewportRect& rect, float scale) {
    if (!mSession.hasWorld()) {
        return;
    }
    drawBrush(list, rect, scale);
    drawControls(list, rect, scale);
    const BoundingSphere& object = mSession.world().scatteringSphere;
    for (std::size_t i = 0; i < mSession.rig.lights.size(); ++i) {
        const RigLight& item = mSession.rig.lights[i];
        const glm::dvec3 at = gizmoPosition(item.light, object);
        if (projected(mSession.camera, at, rect.aspect()).z <= 0.0) {
            continue;
        }
        const glm::dvec2 p = seenAt(mSession.camera, at, rect);
        if (!rect.contains(p)) {
            continue;
        }
        const glm::dvec3 c = item.light.color / std::max({item.light.color.x, item.light.color.y,
                                                          item.light.color.z, 1e-9});
        const bool isSelected = static_cast<int>(i) == mSession.selectedLight;
        const ImU32 fill = ImGui::GetColorU32(
            ImVec4(float(c.x), float(c.y), float(c.z), item.isOn ? 0.95f : 0.25f));
        const ImU32 line = ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, isSelected ? 0.8f : 0.35f));
        const ImVec2 center(static_cast<float>(p.x), static_cast<float>(p.y));
        // The way of the light, a short line.
        if (item.light.kind != Light::Kind::Point) {
            const glm::dvec3 to = at + 0.22 * object.radius * item.light.direction;
            const glm::dvec2 q = seenAt(mSession.camera, to, rect);
            list.AddLine(center, {static_cast<float>(q.x), static_cast<float>(q.y)}, line,
                         1.5f * scale);
        }
        list.AddCircleFilled(center, 5.0f * scale, fill, 20);
        list.AddCircle(center, 8.0f * scale, line, 24, 1.5f * scale);
    }
}

} // namespace celadon::ui
