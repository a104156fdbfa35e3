#pragma once

#include "ui/session.h"
#include "ui/surface_path.h"
#include "ui/surface_picker.h"
#include "ui/viewport.h"
#include "ui/window.h"

#include <optional>
#include <string>

struct ImDrawList;

/// What the mouse does in the viewport: painting, turning, shifting and zooming the view, dragging
/// lights, control points and handles, changing the brush. Each movement becomes a command.
namespace celadon::ui {

class ViewportTools {
public:
    explicit ViewportTools(Session& session) : mSession(session), mPicker(session) {}

    /// @param overUi the cursor is on a panel, which takes what begins there
    void handle(const InputEvent& event, const ViewportRect& rect, bool overUi);
    /// What handle() would do takes the shape that is shown, and that is still being made: it would
    /// wait for it.
    [[nodiscard]] bool mustWait(const InputEvent& event, const ViewportRect& rect, bool overUi);
    /// From now on that shape is made, without anybody waiting for it.
    void prepare() { static_cast<void>(mPicker.isReady()); }
    /// @return whether a shape that was awaited has come
    [[nodiscard]] bool takeArrived() { return mPicker.takeArrived(); }
    [[nodiscard]] bool isDragging() const { return mDrag != Drag::None; }

    /// Escape: a stroke, a dragged part of the shape, a dragged light or a change of the brush as
    /// if it had never begun; clicks add no handles any more.
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

    /// The surface under a window pixel; null beside the object.
    [[nodiscard]] std::optional<SurfacePoint> pick(glm::dvec2 positionPx,
                                                   const ViewportRect& rect) {
        return mPicker.pick(positionPx, rect);
    }
    /// For scripts: the brush shows at this place of the viewport, (0,0) top left, whatever the
    /// mouse does.
    void pretend(glm::dvec2 place) { mPretended = place; }
    /// What the mouse does now, in a few words; empty where it does nothing but turn the view.
    [[nodiscard]] std::string hint() const;
    /// Whether lights that lie before the object can be dragged; else the brush goes first there.
    void setLightsFirst(bool on) { mLightsFirst = on; }

private:
    enum class Drag { None, Orbit, Pan, Zoom, Light, Control, Path, Line };

    /// What a button does to the view; None: nothing.
    [[nodiscard]] static Drag viewDrag(const InputEvent& event);
    [[nodiscard]] bool picks(const InputEvent& event, const ViewportRect& rect, bool overUi) const;
    void press(const InputEvent& event, const ViewportRect& rect);
    void move(const InputEvent& event, const ViewportRect& rect);
    void wheel(const InputEvent& event, const ViewportRect& rect);
    [[nodiscard]] int lightAt(glm::dvec2 positionPx, const ViewportRect& rect) const;
    [[nodiscard]] int controlAt(glm::dvec2 positionPx, const ViewportRect& rect) const;
    void dragControlBy(glm::dvec2 deltaPx, const ViewportRect& rect);
    /// @return whether the surface is there
    bool addHandleAt(glm::dvec2 positionPx, const ViewportRect& rect);
    void pressTool(const InputEvent& event, const ViewportRect& rect);
    void adjust(glm::dvec2 positionPx);
    void pressSurface(const SurfacePoint& hit, const InputEvent& event, const ViewportRect& rect);
    void drawLineTo(glm::dvec2 positionPx, const ViewportRect& rect);
    void finishDrag();
    [[nodiscard]] std::optional<glm::dvec2> brushPlace(const ViewportRect& rect) const;

    Session& mSession;
    Drag mDrag = Drag::None;
    int mButton = -1;
    int mLight = -1;
    bool mLightsFirst = false;
    double mScale = 1.0;    ///< of the interface: gizmos are caught as far off as they are seen
    int mControl = -1;      ///< of the chosen deformer, that is dragged
    bool mHasMoved = false; ///< a control or a light, by this drag
    glm::dvec2 mLast{0.0};
    glm::dvec3 mPivot{0.0};
    glm::dvec2 mCursor{-1.0};
    bool mIsOverUi = true;
    struct Adjusting {
        Adjust what = Adjust::Radius;
        glm::dvec2 start{0.0};
        subedit::Brush brush;
    };
    std::optional<Adjusting> mAdjust;
    SurfacePicker mPicker;
    SurfacePath mPath{mSession, mPicker};
    std::optional<glm::dvec2> mPretended;
    glm::dvec3 mLineFrom{0.0}; ///< of a gradient
};

} // namespace celadon::ui
