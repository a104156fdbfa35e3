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

std::optional<SurfacePicker::Hit> SurfacePicker::hitAt(glm::dvec2 positionPx,
                                                       const ViewportRect& rect) {
    const ShownShape* const shape = mShapes.current();
    if (shape == nullptr) {
        return std::nullopt;
    }
    const Ray ray = rayThrough(mSession.camera, rect.place(positionPx), rect.aspect());
    const auto hit = shape->rays->nearest(ray.origin, ray.direction);
    return hit ? std::optional(Hit{*hit, *shape}) : std::nullopt;
}

std::optional<SurfacePoint> SurfacePicker::pick(glm::dvec2 positionPx, const ViewportRect& rect) {
    const std::optional<Hit> hit = hitAt(positionPx, rect);
    return hit ? std::optional(surfacePoint(*hit->shape.world, hit->onShape.place)) : std::nullopt;
}

std::optional<SurfacePoint> SurfacePicker::pickAtRest(glm::dvec2 positionPx,
                                                      const ViewportRect& rect) {
    const std::optional<Hit> hit = hitAt(positionPx, rect);
    if (!hit) {
        return std::nullopt;
    }
    const World& rest = *hit->shape.rest;
    return surfacePoint(rest, samePlace(hit->onShape.place, *hit->shape.world, rest));
}

glm::dvec3 SurfacePicker::shown(const glm::dvec3& restMm) const {
    const ShownShape* const shape = mShapes.latest();
    if (shape == nullptr || shape->rest != mSession.sharedWorld() || shape->world == shape->rest) {
        return restMm;
    }
    const double reach = 1e-3 * shape->rest->scatteringSphere.radius;
    std::optional<RayScene::Hit> nearest;
    for (int axis = 0; axis < 3; ++axis) { // one of them is steep enough to the surface
        glm::dvec3 direction(0.0);
        direction[axis] = 1.0;
        const auto hit =
            shape->restRays->nearest(restMm - reach * direction, direction, 2.0 * reach);
        if (hit && (!nearest ||
                    std::abs(hit->distanceMm - reach) < std::abs(nearest->distanceMm - reach))) {
            nearest = hit;
        }
    }
    return nearest
               ? surfacePoint(*shape->world, samePlace(nearest->place, *shape->rest, *shape->world))
                     .positionMm
               : restMm;
}

glm::dvec3 SurfacePicker::laidOn(const glm::dvec3& p, const glm::dvec3& normal, double reachMm) {
    const ShownShape* const shape = mShapes.current();
    if (shape == nullptr) {
        return p;
    }
    const auto down = shape->rays->nearest(p + reachMm * normal, -normal);
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
