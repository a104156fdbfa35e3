#pragma once

#include "renderer/output/frame_stats.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/world.h"
#include "renderer/shading/tone_map_pass.h"
#include "renderer/shading/view_mode_pass.h"
#include "subedit/map/texel_rect.h"
#include "subedit/paint/surface.h"
#include "ui/motion_state.h"
#include "ui/quality_ladder.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// What the viewport asks the picture's thread for, and gets.
namespace celadon::ui {

/// Everything that a picture of the viewport depends on besides the world.
struct PictureRequest {
    std::uint64_t revision = 0; ///< of what is shown; comes back with the picture
    glm::ivec2 windowSizePx{0};
    int rungIndex = 0;
    Rung rung;
    Camera camera; ///< mm
    std::vector<Light> lights;
    Environment environment;
    bool specular = true;
    MotionSetting motion;
    WindowDisplay display;
    ViewModeSettings view;
    int overlayMaterial = -1;                        ///< whose selection is drawn over the picture
    int activeMaterial = 0;                          ///< whose map ViewMode::Atlas shows
    std::shared_ptr<const subedit::Surface> surface; ///< of that map; Atlas only
    bool wantsCounts = false;                        ///< of samples and pairs: they take a moment
};

struct Picture {
    std::uint64_t revision = 0;
    int rungIndex = 0;
    glm::ivec2 windowSizePx{0};
    glm::ivec2 sizePx{0};
    std::vector<std::uint8_t> rgba; ///< rows from the bottom
    double timeMs = 0.0;
    bool isFirst = false; ///< of its size and quality: shaders were compiled meanwhile
    StageMilliseconds stages;
    std::optional<SampleCounts> counts;     ///< where they were wanted
    std::vector<std::size_t> shownPerLevel; ///< dots of ViewMode::Samples
};

/// Changed texels of one material, row by row, [height][width][knots][3]; or all of it, another
/// size or layout included.
struct MaterialPatch {
    int material = 0;
    subedit::TexelRect rect;
    std::vector<float> logProfile;
    std::shared_ptr<const subedit::MaterialMap> whole; ///< instead of rect and texels
};

/// A copy of a rectangle's texels. @param map keeps its layout until the patch is applied
[[nodiscard]] MaterialPatch makePatch(int material, const subedit::MaterialMap& map,
                                      const subedit::TexelRect& rect);

/// Weights of a selection as bytes, [height][width] of the material's map.
struct SelectionWeights {
    int material = 0;
    glm::ivec2 size{0};
    std::vector<std::uint8_t> weights;
};

} // namespace celadon::ui
