#include "ui/viewport_tools.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>
#include <imgui.h>

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
    if (mRayWorld != mSession.sharedWorld()) {
        mRays.reset();
        mRayWorld = mSession.sharedWorld();
        mRays = std::make_unique<RayScene>(*mRayWorld);
    }
    return mRays.get();
}

std::optional<SurfacePoint> ViewportTools::pick(glm::dvec2 positionPx, const ViewportRect& rect) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return std::nullopt;
    }
    const Ray ray = rayThrough(mSession.camera, rect.place(positionPx), rect.aspect());
    const std::optional<RayScene::Hit> hit = scene->nearest(ray.origin, ray.direction);
    return hit ? std::optional(surfacePoint(*mRayWorld, hit->place)) : std::nullopt;
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

void ViewportTools::handle(const InputEvent& event, const ViewportRect& rect, bool overUi) {
    if (!mSession.hasWorld()) {
        mDrag = Drag::None;
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
        mLight = lightAt(event.positionPx, rect);
        if (mLight >= 0) {
            mDrag = Drag::Light;
            mSession.perform({"light.select", {{"light", mLight}}});
            return;
        }
        mDrag = Drag::Orbit;
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
    case Drag::None:
        break;
    }
}

void ViewportTools::wheel(const InputEvent& event, const ViewportRect& rect) {
    mSession.perform({"camera.zoom",
                      {{"factor", std::pow(kZoomPerNotch, event.wheel)},
                       {"point", toJson(pivot(event.positionPx, rect))}}});
}

void ViewportTools::drawOverlay(ImDrawList& list, const ViewportRect& rect, float scale) const {
    if (!mSession.hasWorld()) {
        return;
    }
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
