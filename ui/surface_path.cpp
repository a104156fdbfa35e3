#include "ui/surface_path.h"

#include "subedit/errors.h"
#include "ui/camera_controller.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace celadon::ui {

namespace {

/// Its points as numbers, and which of them begin anew after a gap.
Command scribbleCommand(const std::vector<subedit::StrokePoint>& path, bool isInverted) {
    Command command{"scribble.add", {{"strength", isInverted ? 0.0 : 1.0}}};
    std::vector<double> numbers;
    std::vector<std::size_t> lifted;
    for (std::size_t i = 0; i < path.size(); ++i) {
        for (const glm::dvec3 v : {glm::dvec3(path[i].positionMm), glm::dvec3(path[i].normal)}) {
            numbers.insert(numbers.end(), {v.x, v.y, v.z});
        }
        if (path[i].isLifted) {
            lifted.push_back(i);
        }
    }
    command.arguments["path"] = numbers;
    if (!lifted.empty()) {
        command.arguments["lifted"] = lifted;
    }
    return command;
}

} // namespace

void SurfacePath::begin(Kind kind, const InputEvent& event, int material, bool isInverted,
                        const ViewportRect& rect) {
    mKind = kind;
    mIsInverted = isInverted;
    mMaterial = material;
    mReachedPx = event.positionPx;
    mReachedPressure = pressureOf(event);
    mLastPoint.reset();
    mScribble.clear();
    add(mReachedPx, mReachedPressure, rect);
}

void SurfacePath::continueTo(const InputEvent& event, const ViewportRect& rect) {
    // A fast hand: points between, so that the path follows the surface.
    constexpr int kMostPoints = 2048; // more than a window is wide, at a pixel each
    const glm::dvec2 from = mReachedPx;
    const float pressure = pressureOf(event);
    double stepPx = 8.0;
    if (mLastPoint) {
        const double mmPerPx = pictureHeightMm(mSession.camera, *mLastPoint) / rect.size.y;
        stepPx = std::max(1.0, 0.5 * static_cast<double>(mSession.paint.brush.radiusMm) / mmPerPx);
    }
    const int steps =
        std::clamp(static_cast<int>(std::ceil(glm::distance(from, event.positionPx) / stepPx)), 1,
                   kMostPoints);
    for (int i = 1; i <= steps; ++i) {
        const double along = static_cast<double>(i) / steps;
        add(glm::mix(from, event.positionPx, along),
            glm::mix(mReachedPressure, pressure, static_cast<float>(along)), rect);
    }
    mReachedPx = event.positionPx;
    mReachedPressure = pressure;
}

void SurfacePath::finish() {
    if (mKind == Kind::Scribble) {
        mSession.perform(scribbleCommand(mScribble, mIsInverted));
        mScribble.clear();
    } else {
        mSession.endStroke();
    }
}

std::optional<subedit::StrokePoint> SurfacePath::pointAt(glm::dvec2 positionPx, float pressure,
                                                         const ViewportRect& rect) {
    const std::optional<SurfacePoint> hit = mPicker.pickAtRest(positionPx, rect);
    if (!hit || hit->material < 0 || hit->material != mMaterial) {
        mLastPoint.reset();
        return std::nullopt;
    }
    subedit::StrokePoint point;
    point.positionMm = glm::vec3(hit->positionMm);
    point.normal = glm::vec3(hit->shadingNormal);
    point.pressure = pressure;
    // After a gap, or where the surface jumps, the path begins anew: nothing between is painted.
    constexpr double kJump = 2.5; // radii
    point.isLifted = !mLastPoint || glm::distance(*mLastPoint, hit->positionMm) >=
                                        kJump * static_cast<double>(mSession.paint.brush.radiusMm);
    mLastPoint = hit->positionMm;
    return point;
}

void SurfacePath::add(glm::dvec2 positionPx, float pressure, const ViewportRect& rect) {
    std::optional<subedit::StrokePoint> point = pointAt(positionPx, pressure, rect);
    if (!point) {
        return;
    }
    if (mKind == Kind::Scribble) {
        point->isLifted = point->isLifted && !mScribble.empty();
        mScribble.push_back(*point);
    } else if (mSession.isStrokeOpen()) {
        mSession.addStrokePoint(*point);
    } else {
        point->isLifted = false;
        try {
            mSession.beginStroke(mMaterial, *point, mIsInverted);
        } catch (const Error& error) {
            mSession.notify(error);
        }
    }
}

float SurfacePath::pressureOf(const InputEvent& event) const {
    return mSession.paint.heedsPressure ? event.pressure : 1.0f;
}

} // namespace celadon::ui
