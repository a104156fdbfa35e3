#pragma once

#include "app/plot/drawing.h"
#include "renderer/output/image.h"

namespace celadon::plot {

/// The drawing on white, display-encoded R,G,B, antialiased. @param scale pixels per unit
[[nodiscard]] FloatImage rasterize(const Drawing& drawing, double scale);

} // namespace celadon::plot
