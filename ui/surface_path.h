#pragma once

#include "ui/session.h"
#include "ui/surface_picker.h"
#include "ui/viewport.h"
#include "ui/window.h"

#include <optional>
#include <vector>

/// What the hand draws on the surface while the button is down, a stroke of the brush or a
/// scribble: along the surface, on one material.
namespace celadon::ui {

class SurfacePath {
public:
    enum class Kind { Stroke, Scribble };

    SurfacePath(Session& session, SurfacePicker& picker) : mSession(session), mPicker(picker) {}

    /// At a place of the surface. @param isInverted the other way: Ctrl, or the pen's eraser
    void begin(Kind kind, const InputEvent& event, int material, bool isInverted,
               const ViewportRect& rect);
    void continueTo(const InputEvent& event, const ViewportRect& rect);
    void finish();

private:
    /// None beside the surface.
    [[nodiscard]] std::optional<subedit::StrokePoint> pointAt(glm::dvec2 positionPx, float pressure,
                                                              const ViewportRect& rect);
    void add(glm::dvec2 positionPx, float pressure, const ViewportRect& rect);
    /// Of a brush that listens to it; else 1.
    [[nodiscard]] float pressureOf(const InputEvent& event) const;

    Session& mSession;
    SurfacePicker& mPicker;
    Kind mKind = Kind::Stroke;
    glm::dvec2 mReachedPx{0.0};    ///< where it has come
    float mReachedPressure = 1.0f; ///< and with how much pressure
    bool mIsInverted = false;
    int mMaterial = -1;                   ///< on which it began, and stays
    std::optional<glm::dvec3> mLastPoint; ///< mm; none after a gap
    std::vector<subedit::StrokePoint> mScribble;
};

} // namespace celadon::ui
