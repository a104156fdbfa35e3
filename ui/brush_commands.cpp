// Commands about the tool in hand. Lengths in mm.
#include "subedit/errors.h"
#include "ui/session.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <utility>

namespace celadon::ui {

namespace {

glm::vec3 colorArgument(const Arguments& a, const char* name) {
    return glm::clamp(glm::vec3(a.vector3(name)), 0.0f, 1.0f);
}

void changeBrush(subedit::Brush& brush, const Arguments& a) {
    const auto take = [&a](const char* name, float& value, double least, double most) {
        if (a.has(name)) {
            value = static_cast<float>(a.numberWithin(name, least, most));
        }
    };
    subedit::Brush changed = brush;
    take("radius", changed.radiusMm, 1e-3, 1e4);
    take("hardness", changed.hardness, 0.0, 1.0);
    take("flow", changed.flow, 1e-3, 1.0);
    take("opacity", changed.opacity, 1e-3, 1.0);
    take("spacing", changed.spacing, 0.02, 4.0);
    brush = changed;
}

Tool parseTool(const std::string& name) {
    for (const auto& [word, tool] :
         {std::pair{"paint", Tool::Paint}, std::pair{"select", Tool::Select},
          std::pair{"similar", Tool::Similar}, std::pair{"pick", Tool::Pick},
          std::pair{"scribble", Tool::Scribble}, std::pair{"stamp", Tool::Stamp}}) {
        if (name == word) {
            return tool;
        }
    }
    throw UsageError("tool '" + name + "'", "there is no such tool",
                     "choose paint, select, similar, pick, scribble or stamp");
}

void changeOperator(PaintState& paint, const Arguments& a) {
    PaintState changed = paint;
    if (a.has("name")) {
        changed.op = parsePaintOperator(a.text("name"));
    }
    if (a.has("amount")) {
        changed.amount = static_cast<float>(a.numberWithin("amount", 0.0, 1.0));
    }
    if (a.has("albedoFactor")) {
        changed.albedoFactor = static_cast<float>(a.numberWithin("albedoFactor", 0.05, 20.0));
    }
    if (a.has("rangeFactor")) {
        changed.rangeFactor = static_cast<float>(a.numberWithin("rangeFactor", 0.05, 20.0));
    }
    if (a.has("enhance")) {
        changed.enhanceAmount = static_cast<float>(a.numberWithin("enhance", -1.0, 4.0));
    }
    if (a.has("neighborhood")) {
        changed.neighborhoodMm = static_cast<float>(a.numberWithin("neighborhood", 1e-2, 1e3));
    }
    if (a.has("tolerance")) {
        changed.tolerance = static_cast<float>(a.numberWithin("tolerance", 1e-3, 1.0));
    }
    if (a.has("angle")) {
        changed.copyAngleDegrees = static_cast<float>(a.numberWithin("angle", -180.0, 180.0));
    }
    if (a.has("strength")) {
        changed.patternStrength = static_cast<float>(a.numberWithin("strength", 0.0, 4.0));
    }
    if (a.has("color")) {
        changed.color = colorArgument(a, "color");
    }
    if (a.has("range")) {
        changed.rangeMm = glm::clamp(glm::vec3(a.vector3("range")), 1e-3f, 1e3f);
    }
    paint = std::move(changed);
}

} // namespace

void addBrushCommands(Session& session) {
    Dispatcher& commands = session.dispatcher();
    commands.add("brush.change", "Radius in mm, hardness, flow, opacity, spacing in radii",
                 [&session](const Arguments& a) { changeBrush(session.paint.brush, a); });
    commands.add("brush.pressure", "Whether a pen's pressure scales the flow: on",
                 [&session](const Arguments& a) { session.paint.heedsPressure = a.flag("on"); });
    commands.add("operator.change", "Which operator the brush applies, and how much of it",
                 [&session](const Arguments& a) { changeOperator(session.paint, a); });
    commands.add("brush.mirror", "Repeats strokes on the other side of the object: x, y, z",
                 [&session](const Arguments& a) {
                     const char* const names[3] = {"x", "y", "z"};
                     for (int i = 0; i < 3; ++i) {
                         session.paint.mirror[i] = a.flag(names[i], session.paint.mirror[i]);
                     }
                 });
    commands.add(
        "tool.choose", "paint, select, similar, pick, scribble or stamp",
        [&session](const Arguments& a) { session.paint.tool = parseTool(a.text("name")); });
    commands.add("gradient.line", "Where a gradient begins and ends: from and to in mm",
                 [&session](const Arguments& a) {
                     session.paint.gradientFromMm = glm::vec3(a.vector3("from"));
                     session.paint.gradientToMm = glm::vec3(a.vector3("to"));
                 });
}

} // namespace celadon::ui
