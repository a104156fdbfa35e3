#pragma once

#include "renderer/reference/ray_scene.h"
#include "ui/session.h"
#include "ui/viewport.h"
#include "ui/window.h"

#include <memory>
#include <optional>

struct ImDrawList;

/// What the mouse does in the viewport: turning, shifting and zooming the view, dragging lights.
/// Each movement becomes a command.
namespace celadon::ui {

class ViewportTools {
public:
    explicit ViewportTools(Session& session) : mSession(session) {}

    /// @param overUi the cursor is on a panel, which takes what begins there
    void handle(const InputEvent& event, const ViewportRect& rect, bool overUi);
    [[nodiscard]] bool isDragging() const { return mDrag != Drag::None; }

    /// Gizmos of the lights.
    void drawOverlay(ImDrawList& list, const ViewportRect& rect, float scale) const;

    /// The surface under a window pixel; null beside the object.
    [[nodiscard]] std::optional<SurfacePoint> pick(glm::dvec2 positionPx, const ViewportRect& rect);

private:
    enum class Drag { None, Orbit, Pan, Zoom, Light };

    void press(const InputEvent& event, const ViewportRect& rect);
    void move(const InputEvent& event, const ViewportRect& rect);
    void wheel(const InputEvent& event, const ViewportRect& rect);
    [[nodiscard]] int lightAt(glm::dvec2 positionPx, const ViewportRect& rect) const;
    [[nodiscard]] glm::dvec3 pivot(glm::dvec2 positionPx, const ViewportRect& rect);
    const RayScene* rays();

    Session& mSession;
    Drag mDrag = Drag::None;
    int mButton = -1;
    int mLight = -1;
    glm::dvec2 mLast{0.0};
    glm::dvec3 mPivot{0.0};
    std::shared_ptr<const World> mRayWorld; ///< of mRays, which refers to it
    std::unique_ptr<RayScene> mRays;
};

} // namespace celadon::ui
