#pragma once

#include "renderer/reference/ray_scene.h"
#include "ui/session.h"
#include "ui/viewport.h"
#include "ui/window.h"

#include <memory>
#include <optional>

struct ImDrawList;

/// What the mouse does in the viewport: painting, turning, shifting and zooming the view, dragging
/// lights, changing the brush. Each movement becomes a command.
namespace celadon::ui {

class ViewportTools {
public:
    explicit ViewportTools(Session& session) : mSession(session) {}

    /// @param overUi the cursor is on a panel, which takes what begins there
    void handle(const InputEvent& event, const ViewportRect& rect, bool overUi);
    [[nodiscard]] bool isDragging() const { return mDrag != Drag::None; }

    /// Escape: a stroke or a change of the brush as if it had never begun.
    void cancel();
    enum class Adjust { Radius, Strength };
    /// From now on the mouse, moved sideways, changes the brush, until a button or cancel().
    void beginAdjust(Adjust what);
    [[nodiscard]] bool isAdjusting() const { return mAdjust.has_value(); }

    /// Gizmos of the lights, the brush on the surface.
    void drawOverlay(ImDrawList& list, const ViewportRect& rect, float scale);
    /// The brush shows where the cursor is.
    void hover(glm::dvec2 positionPx, bool overUi) {
        mCursor = positionPx;
        mIsOverUi = overUi;
    }
    [[nodiscard]] glm::dvec2 cursor() const { return mCursor; }

    /// The surface under a window pixel, as it is shown; null beside the object.
    [[nodiscard]] std::optional<SurfacePoint> pick(glm::dvec2 positionPx, const ViewportRect& rect);
    /// The same point on the rest shape, where materials and handles are.
    [[nodiscard]] std::optional<SurfacePoint> pickAtRest(glm::dvec2 positionPx,
                                                         const ViewportRect& rect);

private:
    enum class Drag { None, Orbit, Pan, Zoom, Light, Control, Paint };

    void press(const InputEvent& event, const ViewportRect& rect);
    void move(const InputEvent& event, const ViewportRect& rect);
    void wheel(const InputEvent& event, const ViewportRect& rect);
    [[nodiscard]] int lightAt(glm::dvec2 positionPx, const ViewportRect& rect) const;
    [[nodiscard]] int controlAt(glm::dvec2 positionPx, const ViewportRect& rect) const;
    [[nodiscard]] std::optional<RayScene::Hit> hitAt(glm::dvec2 positionPx,
                                                     const ViewportRect& rect);
    void drawControls(ImDrawList& list, const ViewportRect& rect, float scale) const;
    [[nodiscard]] glm::dvec3 pivot(glm::dvec2 positionPx, const ViewportRect& rect);
    const RayScene* rays();
    void pressTool(const InputEvent& event, const ViewportRect& rect);
    void paintTo(glm::dvec2 positionPx, const ViewportRect& rect);
    bool paintPoint(glm::dvec2 positionPx, const ViewportRect& rect);
    void adjust(glm::dvec2 positionPx);
    void drawBrush(ImDrawList& list, const ViewportRect& rect, float scale);

    Session& mSession;
    Drag mDrag = Drag::None;
    int mButton = -1;
    int mLight = -1;
    int mControl = -1; ///< that is dragged
    glm::dvec2 mLast{0.0};
    glm::dvec3 mPivot{0.0};
    glm::dvec2 mCursor{-1.0};
    bool mIsOverUi = true;
    glm::dvec2 mPaintedPx{0.0};           ///< where the stroke has come
    bool mInverted = false;               ///< Ctrl was down as the stroke began
    std::optional<glm::dvec3> mLastPoint; ///< of the stroke, mm; none after a gap
    struct Adjusting {
        Adjust what = Adjust::Radius;
        glm::dvec2 start{0.0};
        subedit::Brush brush;
    };
    std::optional<Adjusting> mAdjust;
    std::shared_ptr<const World> mRayWorld; ///< of mRays, which refers to it
    std::unique_ptr<RayScene> mRays;
};

} // namespace celadon::ui
