#pragma once

#include "renderer/gather/changed_texels.h"
#include "renderer/gather/pixel_tiles.h"
#include "renderer/gather/sample_tree.h"
#include "renderer/gather/tree_change.h"
#include "renderer/gather/view_texels.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>

/// Splatting turned around: each tile of pixels gathers the samples that reach it, from the tree,
/// at each level of the splatting buffer. The same sums as the raster path (DESIGN 3.3). No GL
/// here.
namespace celadon {

/// What changed since the exitance of a level was gathered, in the same view.
struct GatherChange {
    const TreeChange& tree;
    const ChangedTexels& texels; ///< of the pixels' own profiles
};

struct GatherSettings {
    bool hierarchical = true;
    bool multiresolution = true;
    float fade = 0.6f;        ///< b
    float pixelAngle = 0.2f;  ///< theta_p
    glm::mat4 view{1.0f};     ///< world mm to view, -z forward
    float pixelScale = 0.0f;  ///< width of a pixel of level 0 at view depth z:
    float pixelOffset = 0.0f; ///< z * pixelScale + pixelOffset, mm
    /// Paper: Rbar(T) of a material (eq. 14).
    std::function<float(float pixelsPerRadius, int material)> minimalRadius;
};

/// Writes what the tree's samples bring to one level of the splatting buffer, where something
/// scatters. @return pairs
/// @param tiles   of `view` at this level
/// @param level   which of `levelCount`
/// @param change  null: all is gathered. Else what the changed samples brought is taken away from
///                the sums, and what they bring now added: what gathering all again would find, but
///                for rounding (1e-6 of the brightest). Tiles that nothing of it reaches stay as
///                they are, bit for bit. Hierarchical only.
std::uint64_t gatherLevel(const SampleTree& tree, const GatherMaterials& materials,
                          const ViewTexels& view, const PixelTiles& tiles, int level,
                          int levelCount, const GatherSettings& settings,
                          const GatherChange* change = nullptr);

} // namespace celadon
