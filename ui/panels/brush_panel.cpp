#include "ui/panels/brush_panel.h"

#include "ui/theme.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/profile_swatch.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

namespace celadon::ui {

namespace {

void change(Session& session, const char* command, const char* name, double value) {
    session.perform({command, {{name, value}}});
}

constexpr std::array<const char*, 6> kToolLabels{"Paint", "Select",   "Similar",
                                                 "Pick",  "Scribble", "Stamp"};
constexpr std::array<const char*, 6> kToolWords{"paint", "select",   "similar",
                                                "pick",  "scribble", "stamp"};
constexpr std::array<const char*, 6> kToolHelps{
    "Strokes apply the operator (B)",
    "Strokes add to the selection; with Ctrl they take away (M)",
    "A click selects what has a profile like the one there; with Shift it adds",
    "A click takes the profile there as primary (S)",
    "Rough strokes over what you mean, with Ctrl over what is to stay: the operator spreads to all "
    "that resembles them",
    "A click applies the operator as a picture says: white all, black nothing"};

void drawTools(Session& session) {
    const int current = static_cast<int>(session.paint.tool);
    constexpr int kPerRow = 3;
    for (int row = 0; row < 2; ++row) {
        const auto first = static_cast<std::size_t>(row * kPerRow);
        const int tool = choiceRow(row == 0 ? "tools" : "more tools", kToolLabels.data() + first,
                                   kToolHelps.data() + first, kPerRow, current - row * kPerRow);
        if (tool >= 0) {
            const std::size_t which = first + static_cast<std::size_t>(tool);
            session.perform({"tool.choose", {{"name", kToolWords[which]}}});
        }
    }
}

void drawScribbles(Session& session) {
    if (session.paint.tool != Tool::Scribble) {
        return;
    }
    heading("Propagation");
    const subedit::Propagation& propagation = session.paint.propagation;
    if (propagation.scribbles.empty()) {
        hint("Scribble on the model. Texels like those under a scribble will get the operator.");
    }
    float similarity = propagation.similarity;
    if (sliderField("Similarity", similarity, 0.01f, 0.5f, "%.3f",
                    "Difference of profiles at which the effect has fallen to 1/e", true)) {
        change(session, "scribble.change", "similarity", static_cast<double>(similarity));
    }
    const auto most = static_cast<float>(2.0 * session.world().scatteringSphere.radius);
    float distance = propagation.distanceMm.value_or(0.0f);
    if (sliderField("Distance", distance, 0.0f, most, distance > 0.0f ? "%.1f mm" : "any",
                    "Distance in space at which the effect has fallen to 1/e, mm; 0: anywhere")) {
        change(session, "scribble.change", "distance", static_cast<double>(distance));
    }
    constexpr std::array<const char*, 3> kLabels{"Apply", "Select", "Clear"};
    constexpr std::array<const char*, 3> kHelps{"Spreads the operator above from the scribbles",
                                                "Selects what they spread to",
                                                "Takes the scribbles away"};
    ImGui::BeginDisabled(propagation.scribbles.empty());
    const int clicked = choiceRow("spread", kLabels.data(), kHelps.data(), 3, -1);
    ImGui::EndDisabled();
    if (clicked == 2) {
        session.perform({"scribble.clear"});
    } else if (clicked >= 0) {
        session.perform({"scribble.apply", {{"select", clicked == 1}}});
    }
}

void drawStamp(const LayoutContext& context) {
    Session& session = context.session;
    if (session.paint.tool != Tool::Stamp) {
        return;
    }
    heading("Stamp");
    const StampImage& stamp = session.paint.stamp;
    if (ImGui::Button(stamp.isSet() ? "Another image\xe2\x80\xa6" : "Open an image\xe2\x80\xa6",
                      {-1.0f, 0.0f})) {
        context.actions.openStamp();
    }
    tooltip("PNG, JPEG, TIFF or EXR; one can be dropped on the window, too");
    if (stamp.isSet()) {
        readout("Image", fmt::format("{}, {}\xc3\x97{}", stamp.name, stamp.width, stamp.height),
                "As stamped: at most 192 pixels a side");
    }
    float angle = session.paint.stampAngleDegrees;
    if (sliderField("Angle", angle, -180.0f, 180.0f, "%.0f\xc2\xb0",
                    "Counter-clockwise, in degrees; 0: its top is up")) {
        change(session, "stamp.change", "angle", static_cast<double>(angle));
    }
    hint("Its width is twice the brush radius.");
}

void drawSelection(Session& session) {
    heading("Selection");
    if (session.paint.tool == Tool::Similar) {
        float tolerance = session.paint.tolerance;
        if (sliderField("Tolerance", tolerance, 0.005f, 1.0f, "%.3f",
                        "How far a profile may be from the one that is clicked", true)) {
            change(session, "operator.change", "tolerance", static_cast<double>(tolerance));
        }
    }
    const auto step = [&](const char* what) {
        session.perform({"select.change", {{"what", what}}});
    };
    constexpr std::array<const char*, 3> kWhole{"All", "None", "Invert"};
    constexpr std::array<const char*, 3> kWholeWords{"all", "none", "invert"};
    constexpr std::array<const char*, 3> kWholeHelps{
        "Everything: edits apply everywhere (Ctrl+A)",
        "Nothing: edits do nothing until something is selected (Ctrl+D)",
        "What is not selected now (Ctrl+I)"};
    const int whole = choiceRow("whole", kWhole.data(), kWholeHelps.data(), 3, -1);
    if (whole >= 0) {
        step(kWholeWords[static_cast<std::size_t>(whole)]);
    }
    constexpr std::array<const char*, 3> kEdge{"Grow", "Shrink", "Feather"};
    constexpr std::array<const char*, 3> kEdgeWords{"grow", "shrink", "feather"};
    constexpr std::array<const char*, 3> kEdgeHelps{
        "Outwards by a quarter of the brush radius, along the surface",
        "Inwards by a quarter of the brush radius, along the surface",
        "A soft edge, a quarter of the brush radius to both sides"};
    const int edge = choiceRow("edge", kEdge.data(), kEdgeHelps.data(), 3, -1);
    if (edge >= 0) {
        session.perform({"select.change",
                         {{"what", kEdgeWords[static_cast<std::size_t>(edge)]},
                          {"mm", 0.25 * static_cast<double>(session.paint.brush.radiusMm)}}});
    }
}

void drawOperators(Session& session) {
    heading("Operator");
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f;
    int column = 0;
    for (const PaintOperatorName& name : paintOperators()) {
        if (column > 0) {
            ImGui::SameLine(0.0f, gap);
        }
        column = (column + 1) % 3;
        const bool isCurrent = session.paint.op == name.op;
        ImGui::PushStyleColor(ImGuiCol_Button, isCurrent
                                                   ? palette().accentDim
                                                   : ImGui::GetStyleColorVec4(ImGuiCol_Button));
        if (ImGui::Button(name.label, {width, 0.0f})) {
            session.perform({"operator.change", {{"name", std::string(name.word)}}});
        }
        ImGui::PopStyleColor();
        tooltip(name.help);
    }
}

/// What Clone, Pattern and Gradient need besides.
void drawPlaces(Session& session) {
    const PaintState& paint = session.paint;
    const bool isPattern = paint.op == PaintOperator::Pattern;
    if (paint.op == PaintOperator::Gradient && paint.gradientFromMm == paint.gradientToMm) {
        hint("Shift+drag over the model draws the line that it runs along.");
    }
    if (paint.op != PaintOperator::Clone && !isPattern) {
        return;
    }
    hint(paint.cloneSource ? "Paint: the place you chose comes to where the stroke begins."
                           : "Shift+click on the model: where to copy from.");
    float angle = paint.copyAngleDegrees;
    if (sliderField("Angle", angle, -180.0f, 180.0f, "%.0f\xc2\xb0",
                    "By which what is copied is turned, counter-clockwise, in degrees")) {
        change(session, "operator.change", "angle", static_cast<double>(angle));
    }
    float strength = 100.0f * paint.patternStrength;
    if (isPattern && sliderField("Strength", strength, 0.0f, 400.0f, "%.0f %%",
                                 "Of the pattern: 100 % is as it was there")) {
        change(session, "operator.change", "strength", static_cast<double>(strength) / 100.0);
    }
}

void drawParameters(Session& session) {
    PaintState& paint = session.paint;
    if (paint.op == PaintOperator::Profile || paint.op == PaintOperator::Shape ||
        paint.op == PaintOperator::Gradient) {
        drawProfilePair(session);
    }
    drawPlaces(session);
    if (paint.op == PaintOperator::ScaleAlbedo) {
        float factor = paint.albedoFactor;
        if (sliderField("Factor", factor, 0.25f, 4.0f, "\xc3\x97 %.2f",
                        "The diffuse albedo is multiplied by this, up to 1", true)) {
            change(session, "operator.change", "albedoFactor", static_cast<double>(factor));
        }
    }
    if (paint.op == PaintOperator::ScaleRange) {
        float factor = paint.rangeFactor;
        if (sliderField("Factor", factor, 0.25f, 4.0f, "\xc3\x97 %.2f",
                        "The effective scattering radius is multiplied by this", true)) {
            change(session, "operator.change", "rangeFactor", static_cast<double>(factor));
        }
    }
    if (paint.op == PaintOperator::SetAlbedo || paint.op == PaintOperator::Tint) {
        float rgb[3] = {paint.color.r, paint.color.g, paint.color.b};
        if (colorField(paint.op == PaintOperator::Tint ? "Color" : "Albedo", rgb,
                       "Linear; as albedo: the part of the light that comes out again")) {
            session.perform({"operator.change", {{"color", {rgb[0], rgb[1], rgb[2]}}}});
        }
    }
    if (paint.op == PaintOperator::Enhance) {
        float amount = 100.0f * paint.enhanceAmount;
        if (sliderField("Amount", amount, -100.0f, 400.0f, "%+.0f %%",
                        "Differences become this much larger; below zero they are smoothed")) {
            change(session, "operator.change", "enhance", static_cast<double>(amount) / 100.0);
        }
    }
    if (paint.op == PaintOperator::Enhance || paint.op == PaintOperator::Pattern) {
        float radius = paint.neighborhoodMm;
        if (sliderField("Within", radius, 0.5f, 50.0f, "%.1f mm",
                        "Neighborhood on the surface that differences are taken from, mm", true)) {
            change(session, "operator.change", "neighborhood", static_cast<double>(radius));
        }
    }
    if (paint.op == PaintOperator::SetRange) {
        constexpr std::array<const char*, 3> kNames{"Red", "Green", "Blue"};
        for (int c = 0; c < 3; ++c) {
            float radius = paint.rangeMm[c];
            if (sliderField(kNames[static_cast<std::size_t>(c)], radius, 0.1f, 40.0f, "%.2f mm",
                            "Effective scattering radius R_P: holds 95 % of the energy, mm",
                            true)) {
                glm::vec3 range = paint.rangeMm;
                range[c] = radius;
                session.perform({"operator.change", {{"range", {range.r, range.g, range.b}}}});
            }
        }
    }
    if (paint.op == PaintOperator::Profile || paint.op == PaintOperator::Tint) {
        float amount = 100.0f * paint.amount;
        if (sliderField("Amount", amount, 0.0f, 100.0f, "%.0f %%",
                        "How much of it a full stroke mixes in")) {
            change(session, "operator.change", "amount", static_cast<double>(amount) / 100.0);
        }
    }
}

void drawBrush(Session& session, const KeyMap& keys, bool hasPen) {
    heading("Brush");
    const subedit::Brush& brush = session.paint.brush;
    const float size = static_cast<float>(session.world().scatteringSphere.radius);
    float radius = brush.radiusMm;
    if (sliderField(
            "Radius", radius, 0.002f * size, size, "%.2f mm",
            keys.withKeys("On the surface, mm", {Action::Radius, Action::Smaller, Action::Larger})
                .c_str(),
            true)) {
        change(session, "brush.change", "radius", static_cast<double>(radius));
    }
    const auto percent = [&](const char* label, const char* name, float value, const char* help) {
        float shown = 100.0f * value;
        if (sliderField(label, shown, name == std::string_view("hardness") ? 0.0f : 1.0f, 100.0f,
                        "%.0f %%", help)) {
            change(session, "brush.change", name, static_cast<double>(shown) / 100.0);
        }
    };
    percent("Flow", "flow", brush.flow,
            keys.withKeys("What one dab adds", {Action::Strength}).c_str());
    bool heedsPressure = session.paint.heedsPressure;
    if (hasPen && ImGui::Checkbox("Pen pressure scales the flow", &heedsPressure)) {
        session.perform({"brush.pressure", {{"on", heedsPressure}}});
    }
    percent("Opacity", "opacity", brush.opacity, "What one stroke reaches at most");
    percent("Hardness", "hardness", brush.hardness,
            "Part of the radius at full strength; the rest falls off smoothly");
    float spacing = 100.0f * brush.spacing;
    if (sliderField("Spacing", spacing, 5.0f, 200.0f, "%.0f %%",
                    "Distance of dabs along the stroke, in percent of the radius")) {
        change(session, "brush.change", "spacing", static_cast<double>(spacing) / 100.0);
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Mirror");
    tooltip("Repeats strokes on the other side of planes through the object's center");
    constexpr std::array<const char*, 3> kAxes{"X", "Y", "Z"};
    constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x * 0.38f);
    for (std::size_t i = 0; i < 3; ++i) {
        bool isOn = session.paint.mirror[i];
        if (ImGui::Checkbox(kAxes[i], &isOn)) {
            session.perform({"brush.mirror", {{kNames[i], isOn}}});
        }
        tooltip("Across the plane through the object's center that is perpendicular to this axis");
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

void drawHistory(Session& session, const KeyMap& keys) {
    const subedit::Document* const document = session.activeDocument();
    if (document == nullptr) {
        return;
    }
    heading("History");
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2.0f;
    const auto button = [&](const char* label, bool enabled, const char* command,
                            const std::string& help) {
        ImGui::BeginDisabled(!enabled);
        if (ImGui::Button(label, {width, 0.0f})) {
            session.perform({command});
        }
        ImGui::EndDisabled();
        tooltip(help.c_str());
    };
    const std::optional<std::string> undo = session.undoTitle();
    const std::optional<std::string> redo = session.redoTitle();
    button("Undo", undo.has_value(), "edit.undo",
           keys.withKeys(undo.value_or("Nothing to undo"), {Action::Undo}));
    ImGui::SameLine(0.0f, gap);
    button("Redo", redo.has_value(), "edit.redo",
           keys.withKeys(redo.value_or("Nothing to redo"), {Action::Redo}));
}

} // namespace

void drawBrushPanel(const LayoutContext& context) {
    Session& session = context.session;
    if (session.activeDocument() == nullptr) {
        hint(session.services().isPaintable ? "There is no material to paint on."
                                            : "The editor was started with --view-only.");
        return;
    }
    drawTools(session);
    drawOperators(session);
    drawParameters(session);
    drawScribbles(session);
    drawStamp(context);
    if (session.paint.tool != Tool::Scribble) {
        if (ImGui::Button("Fill", {-1.0f, 0.0f})) {
            session.perform({"edit.fill"});
        }
        tooltip("Applies the operator to all that is selected");
    }
    drawBrush(session, context.preferences.keys, context.state.hasPen);
    drawSelection(session);
    drawHistory(session, context.preferences.keys);
}

} // namespace celadon::ui
