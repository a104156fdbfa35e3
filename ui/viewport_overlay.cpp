#include "ui/viewport_overlay.h"

#include "renderer/output/tone_map.h"
#include "ui/camera_controller.h"
#include "ui/deform_controls.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace celadon::ui {

namespace {

constexpr ImU32 kShadow = IM_COL32(0, 0, 0, 130);
constexpr ImU32 kLine = IM_COL32(255, 255, 255, 225);
constexpr ImU32 kFaint = IM_COL32(255, 255, 255, 80);
constexpr ImU32 kAccent = IM_COL32(143, 199, 168, 235);

struct Canvas {
    ImDrawList& list;
    const Session& session;
    const ViewportRect& rect;
    float scale;

    [[nodiscard]] ImVec2 at(const glm::dvec3& point) const {
        const glm::dvec2 p = seenAt(session.camera, point, rect);
        return {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
    [[nodiscard]] bool isInFront(const glm::dvec3& point) const {
        return projected(session.camera, point, rect.aspect()).z > 0.0;
    }
    void line(const ImVec2* points, int count, ImU32 color, bool isClosed) const {
        const ImDrawFlags flags = isClosed ? ImDrawFlags_Closed : 0;
        list.AddPolyline(points, count, kShadow, flags, 3.0f * scale);
        list.AddPolyline(points, count, color, flags, 1.4f * scale);
    }
};

/// Two directions in the tangent plane, the second one upwards as a stamp has it.
std::array<glm::dvec3, 2> tangents(const glm::dvec3& n, double angleDegrees) {
    const glm::dvec3 upwards =
        std::abs(n.y) < 0.99 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(upwards, n));
    const glm::dvec3 up = glm::cross(n, right);
    const double c = std::cos(glm::radians(angleDegrees));
    const double s = std::sin(glm::radians(angleDegrees));
    return {c * right + s * up, c * up - s * right};
}

void drawRing(const Canvas& canvas, SurfacePicker& picker, const SurfacePoint& hit, double radiusMm,
              ImU32 color, bool isFaint) {
    constexpr int kPoints = 48;
    std::array<ImVec2, kPoints> points;
    const auto [side, other] = tangents(hit.shadingNormal, 0.0);
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / kPoints;
        const glm::dvec3 p =
            hit.positionMm + radiusMm * (std::cos(angle) * side + std::sin(angle) * other);
        points[i] = canvas.at(picker.laidOn(p, hit.shadingNormal, 0.35 * radiusMm));
    }
    if (isFaint) {
        canvas.list.AddPolyline(points.data(), kPoints, color, ImDrawFlags_Closed,
                                1.0f * canvas.scale);
    } else {
        canvas.line(points.data(), kPoints, color, true);
    }
}

void drawStampFrame(const Canvas& canvas, SurfacePicker& picker, const SurfacePoint& hit) {
    const PaintState& paint = canvas.session.paint;
    const auto [right, up] =
        tangents(hit.shadingNormal, static_cast<double>(paint.stampAngleDegrees));
    const double half = static_cast<double>(paint.brush.radiusMm);
    const double aspect =
        paint.stamp.isSet() ? static_cast<double>(paint.stamp.height) / paint.stamp.width : 1.0;
    std::vector<ImVec2> points;
    constexpr int kSteps = 10;
    const std::array<glm::dvec2, 4> corners{
        {{-1.0, -aspect}, {1.0, -aspect}, {1.0, aspect}, {-1.0, aspect}}};
    for (std::size_t i = 0; i < 4; ++i) {
        for (int k = 0; k < kSteps; ++k) {
            const glm::dvec2 p =
                half * glm::mix(corners[i], corners[(i + 1) % 4], static_cast<double>(k) / kSteps);
            points.push_back(canvas.at(picker.laidOn(hit.positionMm + p.x * right + p.y * up,
                                                     hit.shadingNormal, 0.35 * half)));
        }
    }
    canvas.line(points.data(), static_cast<int>(points.size()), kLine, true);
    // Which side is up.
    const std::array<ImVec2, 2> tick{canvas.at(hit.positionMm + half * aspect * up),
                                     canvas.at(hit.positionMm + 0.75 * half * aspect * up)};
    canvas.line(tick.data(), 2, kLine, false);
}

void drawBrush(const Canvas& canvas, SurfacePicker& picker, glm::dvec2 at) {
    const PaintState& paint = canvas.session.paint;
    const std::optional<SurfacePoint> hit = picker.pick(at, canvas.rect);
    if (!hit || hit->material < 0) {
        return;
    }
    if (paint.tool == Tool::Stamp) {
        drawStampFrame(canvas, picker, *hit);
        return;
    }
    if (paint.tool == Tool::Pick || paint.tool == Tool::Similar) {
        canvas.list.AddCircle(canvas.at(hit->positionMm), 5.0f * canvas.scale, kLine, 16, 1.5f);
        return;
    }
    const double radius = static_cast<double>(paint.brush.radiusMm);
    const auto hardness = static_cast<double>(paint.brush.hardness);
    drawRing(canvas, picker, *hit, radius, paint.tool == Tool::Paint ? kLine : kAccent, false);
    if (hardness > 0.02 && hardness < 0.98) {
        drawRing(canvas, picker, *hit, radius * hardness, kFaint, true);
    }
}

void drawScribbles(const Canvas& canvas, const SurfacePicker& picker) {
    for (const subedit::Scribble& scribble : canvas.session.paint.propagation.scribbles) {
        const ImU32 color = scribble.strength > 0.5f ? kAccent : IM_COL32(236, 150, 120, 235);
        std::vector<ImVec2> points;
        const auto drawPoints = [&] {
            if (points.size() > 1) {
                canvas.line(points.data(), static_cast<int>(points.size()), color, false);
            } else if (!points.empty()) {
                canvas.list.AddCircleFilled(points.front(), 3.0f * canvas.scale, color);
            }
            points.clear();
        };
        for (const subedit::StrokePoint& point : scribble.path) {
            if (point.isLifted) {
                drawPoints();
            }
            points.push_back(canvas.at(picker.shown(glm::dvec3(point.positionMm))));
        }
        drawPoints();
    }
}

void drawPlaces(const Canvas& canvas, const SurfacePicker& picker) {
    const PaintState& paint = canvas.session.paint;
    if (paint.tool != Tool::Paint) {
        return;
    }
    const bool isCopying = paint.op == PaintOperator::Clone || paint.op == PaintOperator::Pattern;
    if (isCopying && paint.cloneSource) { // a cross where it comes from
        const ImVec2 p = canvas.at(picker.shown(glm::dvec3(paint.cloneSource->positionMm)));
        const float arm = 8.0f * canvas.scale;
        const std::array<ImVec2, 2> across{ImVec2(p.x - arm, p.y), ImVec2(p.x + arm, p.y)};
        const std::array<ImVec2, 2> along{ImVec2(p.x, p.y - arm), ImVec2(p.x, p.y + arm)};
        canvas.line(across.data(), 2, kAccent, false);
        canvas.line(along.data(), 2, kAccent, false);
    }
    if (paint.op == PaintOperator::Gradient && paint.gradientFromMm != paint.gradientToMm) {
        const std::array<ImVec2, 2> ends{canvas.at(picker.shown(glm::dvec3(paint.gradientFromMm))),
                                         canvas.at(picker.shown(glm::dvec3(paint.gradientToMm)))};
        canvas.line(ends.data(), 2, kAccent, false);
        canvas.list.AddCircleFilled(ends[0], 4.0f * canvas.scale, kAccent);
        canvas.list.AddCircle(ends[1], 5.0f * canvas.scale, kAccent, 16, 1.5f * canvas.scale);
    }
}

void drawLights(const Canvas& canvas) {
    const Session& session = canvas.session;
    const BoundingSphere& object = session.world().scatteringSphere;
    for (std::size_t i = 0; i < session.rig.lights.size(); ++i) {
        const RigLight& item = session.rig.lights[i];
        const glm::dvec3 at = gizmoPosition(item.light, object);
        const ImVec2 center = canvas.at(at);
        if (!canvas.isInFront(at) || !canvas.rect.contains({double(center.x), double(center.y)})) {
            continue;
        }
        const glm::dvec3 c = item.light.color / std::max({item.light.color.x, item.light.color.y,
                                                          item.light.color.z, 1e-9});
        const bool isSelected = static_cast<int>(i) == session.selectedLight;
        const ImU32 fill =
            ImGui::GetColorU32(ImVec4(encodeSrgb(float(c.x)), encodeSrgb(float(c.y)),
                                      encodeSrgb(float(c.z)), item.isOn ? 0.95f : 0.25f));
        const ImU32 line = ImGui::GetColorU32(ImVec4(1.0f, 1.0f, 1.0f, isSelected ? 0.8f : 0.35f));
        if (item.light.kind != Light::Kind::Point) { // the way of the light, a short line
            canvas.list.AddLine(center, canvas.at(at + 0.22 * object.radius * item.light.direction),
                                line, 1.5f * canvas.scale);
        }
        canvas.list.AddCircleFilled(center, 5.0f * canvas.scale, fill, 20);
        canvas.list.AddCircle(center, 8.0f * canvas.scale, line, 24, 1.5f * canvas.scale);
    }
}

void drawControls(const Canvas& canvas) {
    const std::vector<DeformControl> controls = shownControls(canvas.session);
    for (const auto& [a, b] : controlLines(canvas.session)) {
        const glm::dvec3& from = controls[static_cast<std::size_t>(a)].shownMm;
        const glm::dvec3& to = controls[static_cast<std::size_t>(b)].shownMm;
        if (canvas.isInFront(from) && canvas.isInFront(to)) {
            canvas.list.AddLine(canvas.at(from), canvas.at(to), kFaint, 1.0f * canvas.scale);
        }
    }
    for (const DeformControl& control : controls) {
        if (!canvas.isInFront(control.shownMm)) {
            continue;
        }
        const ImVec2 at = canvas.at(control.shownMm);
        const bool isChosen = control.index == canvas.session.motion.control;
        const float radius = (isChosen ? 6.0f : 4.5f) * canvas.scale;
        canvas.list.AddCircleFilled(at, radius, isChosen ? kAccent : kLine, 16);
        canvas.list.AddCircle(at, radius, kShadow, 16, 1.2f * canvas.scale);
    }
}

} // namespace

void drawViewportOverlay(ImDrawList& list, const Session& session, SurfacePicker& picker,
                         std::optional<glm::dvec2> brushAt, const ViewportRect& rect, float scale) {
    const ViewMode mode = session.view.mode.mode;
    if (!session.hasWorld() || mode == ViewMode::Irradiance || mode == ViewMode::Atlas) {
        return; // flat pictures: nothing lies there in space
    }
    const Canvas canvas{list, session, rect, scale};
    const ImVec2 low(static_cast<float>(rect.origin.x), static_cast<float>(rect.origin.y));
    list.PushClipRect(
        low, {low.x + static_cast<float>(rect.size.x), low.y + static_cast<float>(rect.size.y)});
    if (session.paint.tool == Tool::Scribble) {
        drawScribbles(canvas, picker);
    }
    drawPlaces(canvas, picker);
    if (brushAt && picker.isReady()) {
        drawBrush(canvas, picker, *brushAt);
    }
    drawLights(canvas);
    drawControls(canvas);
    list.PopClipRect();
}

} // namespace celadon::ui
