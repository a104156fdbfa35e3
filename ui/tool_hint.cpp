#include "ui/tool_hint.h"

#include <fmt/format.h>

namespace celadon::ui {

std::string toolHint(const Session& session) {
    const PaintState& paint = session.paint;
    const std::string size = fmt::format("{:.2f} mm", paint.brush.radiusMm);
    const char* const dot = "   \xc2\xb7   ";
    if (!session.services().isPaintable) {
        return "Left: turn   \xc2\xb7   Shift+middle: shift   \xc2\xb7   Wheel: zoom";
    }
    const char* const turn = "Middle: turn   \xc2\xb7   Wheel: zoom";
    switch (paint.tool) {
    case Tool::Select:
        return fmt::format("Brush a selection, {}{}Ctrl: take away{}{}", size, dot, dot, turn);
    case Tool::Similar:
        return fmt::format("Click: select what looks like it{}Shift: add{}{}", dot, dot, turn);
    case Tool::Pick:
        return fmt::format("Click: take the profile there{}{}", dot, turn);
    case Tool::Scribble:
        return fmt::format("Scribble over what you mean{}Ctrl: over what stays{}then Apply{}{}",
                           dot, dot, dot, turn);
    case Tool::Stamp:
        return paint.stamp.isSet() ? fmt::format("Click: stamp '{}', {} half wide{}{}",
                                                 paint.stamp.name, size, dot, turn)
                                   : std::string("Open an image to stamp, or drop one here");
    case Tool::Paint:
        break;
    }
    const PaintOperatorName& op = paintOperator(paint.op);
    const bool isCopying = paint.op == PaintOperator::Clone || paint.op == PaintOperator::Pattern;
    if (isCopying) {
        return paint.cloneSource
                   ? fmt::format("{}, {}{}Shift+click: another source{}{}", op.label, size, dot,
                                 dot, turn)
                   : fmt::format("{}: Shift+click where to copy from{}{}", op.label, dot, turn);
    }
    if (paint.op == PaintOperator::Gradient && paint.gradientFromMm == paint.gradientToMm) {
        return fmt::format("Gradient: Shift+drag its line over the surface{}{}", dot, turn);
    }
    return op.inverse != nullptr
               ? fmt::format("{}, {}{}Ctrl: {}{}{}", op.label, size, dot, op.inverse, dot, turn)
               : fmt::format("{}, {}{}{}", op.label, size, dot, turn);
}

} // namespace celadon::ui
