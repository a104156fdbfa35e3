#pragma once

#include "app/plot/drawing.h"

#include <string>

namespace celadon::plot {

/// The drawing as a whole SVG document on white; text stays text.
[[nodiscard]] std::string toSvg(const Drawing& drawing);

} // namespace celadon::plot
