#pragma once

#include "renderer/reference/ray_scene.h"
#include "ui/session.h"

#include <glm/vec2.hpp>

#include <memory>
#include <optional>

/// What lies under a place of the viewport.
namespace celadon::ui {

struct ViewportRect;

class SurfacePicker {
public:
    explicit SurfacePicker(Session& session) : mSession(session) {}

    /// The surface under a window pixel, as it is shown; null beside the object.
    [[nodiscard]] std::optional<SurfacePoint> pick(glm::dvec2 positionPx, const ViewportRect& rect);
    /// The same place on the rest shape, where materials and handles are.
    [[nodiscard]] std::optional<SurfacePoint> pickAtRest(glm::dvec2 positionPx,
                                                         const ViewportRect& rect);
    /// Where a point of the rest shape's surface is shown.
    [[nodiscard]] glm::dvec3 shown(const glm::dvec3& restMm);
    /// The surface along a line, near a point of it: p moved along the normal by up to `reachMm`.
    [[nodiscard]] glm::dvec3 laidOn(const glm::dvec3& p, const glm::dvec3& normal, double reachMm);
    /// What the view turns or zooms about: the surface under the cursor, else the point of the ray
    /// that is as deep as the target.
    [[nodiscard]] glm::dvec3 pivot(glm::dvec2 positionPx, const ViewportRect& rect);

private:
    /// Rays against a world, kept until another one is asked for.
    struct Rays {
        std::shared_ptr<const World> world; ///< of `scene`, which refers to it
        std::unique_ptr<RayScene> scene;
        const RayScene& of(const std::shared_ptr<const World>& wanted);
    };
    [[nodiscard]] const RayScene* rays(); ///< of what is shown; null: no world
    [[nodiscard]] std::optional<RayScene::Hit> hitAt(glm::dvec2 positionPx,
                                                     const ViewportRect& rect);

    Session& mSession;
    Rays mShown, mRest;
};

/// Where a point is seen, window pixels.
[[nodiscard]] glm::dvec2 seenAt(const Camera& camera, const glm::dvec3& point,
                                const ViewportRect& rect);

} // namespace celadon::ui
