#include "ui/surface_picker.h"

#include "ui/camera_controller.h"
#include "ui/viewport.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace celadon::ui {

namespace {

/// A place on one shape of a model, on another one: a mesh that is mirrored in one of them has its
/// triangles turned over.
TrianglePoint samePlace(TrianglePoint place, const World& from, const World& to) {
    const auto mesh = static_cast<std::size_t>(place.mesh);
    const std::size_t second = 3 * std::size_t{place.triangle} + 1;
    if (from.meshes[mesh].mesh.indices[second] != to.meshes[mesh].mesh.indices[second]) {
        std::swap(place.u, place.v);
    }
    return place;
}

} // namespace

glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point, const ViewportRect& rect) {
    const glm::dvec3 place = projected(camera, point, rect.aspect());
    return glm::dvec2(rect.origin) + glm::dvec2(place) * glm::dvec2(rect.size);
}

const RayScene& SurfacePicker::Rays::of(const std::shared_ptr<const World>& wanted) {
    if (world != wanted) {
        scene.reset();
        world = wanted;
        scene = std::make_unique<RayScene>(*world);
    }
    return *scene;
}

const RayScene* SurfacePicker::rays() {
    return mSession.hasWorld() ? &mShown.of(mSession.shownWorld()) : nullptr;
}

std::optional<RayScene::Hit> SurfacePicker::hitAt(glm::dvec2 positionPx, const ViewportRect& rect) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return std::nullopt;
    }
    const Ray ray = rayThrough(mSession.camera, rect.place(positionPx), rect.aspect());
    return scene->nearest(ray.origin, ray.direction);
}

std::optional<SurfacePoint> SurfacePicker::pick(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<RayScene::Hit> hit = hitAt(positionPx, rect);
    return hit ? std::optional(surfacePoint(*mShown.world, hit->place)) : std::nullopt;
}

std::optional<SurfacePoint> SurfacePicker::pickAtRest(glm::dvec2 positionPx,
                                                      const ViewportRect& rect) {
    const std::optional<RayScene::Hit> hit = hitAt(positionPx, rect);
    return hit ? std::optional(surfacePoint(mSession.world(),
                                            samePlace(hit->place, *mShown.world, mSession.world())))
               : std::nullopt;
}

glm::dvec3 SurfacePicker::shown(const glm::dvec3& restMm) {
    if (!mSession.hasWorld() || mSession.shownWorld() == mSession.sharedWorld()) {
        return restMm;
    }
    const RayScene& rest = mRest.of(mSession.sharedWorld());
    const double reach = 1e-3 * mSession.world().scatteringSphere.radius;
    std::optional<RayScene::Hit> nearest;
    for (int axis = 0; axis < 3; ++axis) { // one of them is steep enough to the surface
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        const auto hit = rest.nearest(restMm - reach * direction, direction, 2.0 * reach);
        if (hit && (!nearest ||
                    std::abs(hit->distanceMm - reach) < std::abs(nearest->distanceMm - reach))) {
            nearest = hit;
        }
    }
    const World& world = *mSession.shownWorld();
    return nearest
               ? surfacePoint(world, samePlace(nearest->place, mSession.world(), world)).positionMm
               : restMm;
}

glm::dvec3 SurfacePicker::laidOn(const glm::dvec3& p, const glm::dvec3& normal, double reachMm) {
    const RayScene* const scene = rays();
    if (scene == nullptr) {
        return p;
    }
    const auto down = scene->nearest(p + reachMm * normal, -normal);
    return down && down->distanceMm < 2.0 * reachMm ? p + (reachMm - down->distanceMm) * normal : p;
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
