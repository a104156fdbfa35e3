#pragma once

#include "ui/shown_shape.h"

#include <glm/vec2.hpp>

#include <optional>

/// What lies under a place of the viewport. Answers wait for the shape that is shown where that is
/// still being made: who must not wait asks isReady() before.
namespace celadon::ui {

struct ViewportRect;

class SurfacePicker {
public:
    explicit SurfacePicker(Session& session) : mSession(session), mShapes(session) {}

    /// See ShownShapes::isCurrent().
    [[nodiscard]] bool isReady() { return mShapes.isCurrent(); }
    [[nodiscard]] bool takeArrived() { return mShapes.takeArrived(); }

    /// The surface under a window pixel, as it is shown; null beside the object.
    [[nodiscard]] std::optional<SurfacePoint> pick(glm::dvec2 positionPx, const ViewportRect& rect);
    /// The same place on the rest shape, where materials and handles are.
    [[nodiscard]] std::optional<SurfacePoint> pickAtRest(glm::dvec2 positionPx,
                                                         const ViewportRect& rect);
    /// Where a point of the rest shape's surface is shown, or was a moment ago: never waits.
    [[nodiscard]] glm::dvec3 shown(const glm::dvec3& restMm) const;
    /// The surface along a line, near a point of it: p moved along the normal by up to `reachMm`.
    [[nodiscard]] glm::dvec3 laidOn(const glm::dvec3& p, const glm::dvec3& normal, double reachMm);
    /// What the view turns or zooms about: the surface under the cursor, else the point of the ray
    /// that is as deep as the target.
    [[nodiscard]] glm::dvec3 pivot(glm::dvec2 positionPx, const ViewportRect& rect);

private:
    struct Hit {
        RayScene::Hit onShape;
        const ShownShape& shape;
    };
    [[nodiscard]] std::optional<Hit> hitAt(glm::dvec2 positionPx, const ViewportRect& rect);

    Session& mSession;
    ShownShapes mShapes;
};

/// Where a point is seen, window pixels.
[[nodiscard]] glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point,
                                const ViewportRect& rect);

} // namespace celadon::ui
