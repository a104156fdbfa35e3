#include "app/plot/drawing.h"

#include <algorithm>

namespace celadon::plot {

namespace {

void move(Shape& shape, double x) {
    if (auto* text = std::get_if<Text>(&shape)) {
        text->position.x += x;
        return;
    }
    auto& points = std::holds_alternative<Stroke>(shape) ? std::get<Stroke>(shape).points
                                                         : std::get<Fill>(shape).points;
    for (glm::dvec2& point : points) {
        point.x += x;
    }
}

} // namespace

Drawing placeBeside(const std::vector<Drawing>& panels) {
    Drawing all{{0.0, 0.0}, {}};
    for (const Drawing& panel : panels) {
        for (Shape shape : panel.shapes) {
            move(shape, all.size.x);
            all.shapes.push_back(std::move(shape));
        }
        all.size.x += panel.size.x;
        all.size.y = std::max(all.size.y, panel.size.y);
    }
    return all;
}

} // namespace celadon::plot
