#pragma once

#include "ui/viewport.h"

#include <array>

/// Where the time of the latest pictures went: a bar a picture, stages on each other.
namespace celadon::ui {

inline constexpr std::size_t kStageCount = 6;

struct StageRow {
    const char* name;
    unsigned color; ///< of ImGui
    double timeMs;
};

[[nodiscard]] std::array<StageRow, kStageCount> stageRows(const StageMilliseconds& stages);

void drawTimingGraph(const Viewport& viewport, float heightPx);

} // namespace celadon::ui
