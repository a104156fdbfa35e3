#pragma once

#include "app/plot/drawing.h"

#include <filesystem>

namespace celadon::plot {

/// Whether the name ends in .png or .svg, any case.
[[nodiscard]] bool isPlotFile(const std::filesystem::path& file);

/// SVG, or PNG at twice the drawing's units, by the extension; written atomically.
/// @throws UsageError for another extension, OutputError
void writePlot(const std::filesystem::path& file, const Drawing& drawing);

} // namespace celadon::plot
