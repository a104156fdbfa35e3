#include "ui/surface_picker.h"

#include "ui/camera_controller.h"
#include "ui/viewport.h"

#include <glm/geometric.hpp>

namespace celadon::ui {

glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point, const ViewportRect& rect) {
    const glm::dvec3 place = projected(camera, point, rect.aspect());
    return glm::dvec2(rect.origin) + glm::dvec2(place) * glm::dvec2(rect.size);
}

const RayScene* SurfacePicker::rays() {
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

std::optional<SurfacePoint> SurfacePicker::pick(glm::dvec2 positionPx, const ViewportRect& rect) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return std::nullopt;
    }
    const Ray ray = rayThrough(mSession.camera, rect.place(positionPx), rect.aspect());
    const std::optional<RayScene::Hit> hit = scene->nearest(ray.origin, ray.direction);
    return hit ? std::optional(surfacePoint(*mRayWorld, hit->place)) : std::nullopt;
}

glm::dvec3 SurfacePicker::laidOn(const glm::dvec3& p, const glm::dvec3& normal, double reachMm) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return p;
    }
    const auto down = scene->nearest(p + reachMm * normal, -normal);
    return down && down->distanceMm < 2.0 * reachMm
               ? p + (reachMm - down->distanceMm) * normal
               : p;
}

glm::dvec3 SurfacePicker::pivot(glm::dvec2 positionPx, const ViewportRect& rect) {
    if (const std::optional<SurfacePoint> hit = pick(positionPx, rect)) {
        return hit->positionMm;
    }
    const Camera& camera = mSession.camera;
    const Ray ray = rayThrough(camera, rect.place(positionPx), rect.aspect());
    const glm::dvec3 forward = cameraFrame(camera).forward;
    const double along =
        glm::dot(camera.at - ray.origin, forward) / glm::dot(ray.direction, forward);
    return ray.origin + along * ray.direction;
}

} // namespace celadon::ui
